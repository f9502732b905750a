// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/failure.hpp"

#include <new>
#include <stdexcept>

#include "analytic/base/errors.hpp"
#include "numeric/base/errors.hpp"
#include "validation/output/bad_input.hpp"

namespace clatter::validation {

Failure current_failure() {
  using enum FailureKind;
  try {
    throw;
  } catch (const BadInput& error) {
    return {bad_input, error.what()};
  } catch (const numeric::MeshError& error) {
    return {bad_input, error.what()};
  } catch (const analytic::OutsideModelError& error) {
    return {outside_model, error.what()};
  } catch (const std::domain_error& error) {
    return {bad_input, error.what()};
  } catch (const std::logic_error& error) {
    return {defect, std::string("a defect of the program, please report it: ") + error.what()};
  } catch (const std::bad_alloc&) {
    return {not_computed, "the answer takes more memory than there is"};
  } catch (const std::exception& error) {
    return {not_computed, error.what()};
  }
}

int exit_status(FailureKind kind) {
  switch (kind) {
    case FailureKind::bad_input: return 2;
    case FailureKind::not_computed: return 3;
    case FailureKind::outside_model: return 4;
    case FailureKind::defect: return 70;
  }
  return 70;
}

}  // namespace clatter::validation
