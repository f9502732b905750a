// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/measured/robust_fit.hpp"

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multimin.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <limits>
#include <memory>

#include "analytic/base/errors.hpp"

namespace clatter::validation {
namespace {

constexpr double missing = std::numeric_limits<double>::quiet_NaN();
constexpr int most_steps = 2000;
constexpr double shrunk = 1e-6, derivative_step = 0.05;

using Vector = Eigen::VectorXd;
using GslVector = std::unique_ptr<gsl_vector, void (*)(gsl_vector*)>;

GslVector gsl_copy(const std::vector<double>& values) {
  GslVector copy(gsl_vector_alloc(values.size()), gsl_vector_free);
  for (std::size_t i = 0; i < values.size(); ++i) gsl_vector_set(copy.get(), i, values[i]);
  return copy;
}

Vector eigen_copy(const gsl_vector* values) {
  Vector copy(static_cast<Eigen::Index>(values->size));
  for (Eigen::Index i = 0; i < copy.size(); ++i) copy[i] = gsl_vector_get(values, static_cast<std::size_t>(i));
  return copy;
}

double mean_loss(const gsl_vector* point, void* losses) {
  return (*static_cast<const Losses*>(losses))(eigen_copy(point)).mean();
}

/// Parameters in units of their first steps, so that one tolerance serves all.
Vector least_point(const Losses& losses, const FitStart& start) {
  gsl_set_error_handler_off();  // each status is looked at
  const std::size_t count = start.value.size();
  const Losses scaled = [&](const Vector& point) {
    Vector parameters(point.size());
    for (Eigen::Index i = 0; i < point.size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      parameters[i] = start.value[k] + start.step[k] * point[i];
    }
    return losses(parameters);
  };
  gsl_multimin_function function{&mean_loss, count, const_cast<Losses*>(&scaled)};
  const GslVector origin = gsl_copy(std::vector<double>(count, 0)), size = gsl_copy(std::vector<double>(count, 1));
  const std::unique_ptr<gsl_multimin_fminimizer, void (*)(gsl_multimin_fminimizer*)> simplex(
      gsl_multimin_fminimizer_alloc(gsl_multimin_fminimizer_nmsimplex2, count), gsl_multimin_fminimizer_free);
  gsl_multimin_fminimizer_set(simplex.get(), &function, origin.get(), size.get());
  for (int step = 0; step < most_steps; ++step) {
    if (gsl_multimin_fminimizer_iterate(simplex.get()) != 0) break;
    if (gsl_multimin_fminimizer_size(simplex.get()) < shrunk) {
      Vector value = eigen_copy(simplex->x);
      for (Eigen::Index i = 0; i < value.size(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        value[i] = start.value[k] + start.step[k] * value[i];
      }
      return value;
    }
  }
  throw analytic::NumericalError("a fit's simplex did not shrink");
}

/// First and second derivatives of the losses.
class Derivatives {
 public:
  Derivatives(const Losses& losses, const Vector& at, const std::vector<double>& steps)
      : losses_(losses), at_(at), steps_(steps), centre_(losses(at)) {}

  [[nodiscard]] Eigen::MatrixXd first() const {
    Eigen::MatrixXd gradient(centre_.size(), at_.size());
    for (Eigen::Index i = 0; i < at_.size(); ++i) {
      gradient.col(i) = (losses_(moved({{i, 1}})) - losses_(moved({{i, -1}}))) / (2 * step(i));
    }
    return gradient;
  }

  /// Second derivatives of each item's loss.
  [[nodiscard]] std::vector<Eigen::MatrixXd> second() const {
    std::vector<Eigen::MatrixXd> all(static_cast<std::size_t>(centre_.size()),
                                     Eigen::MatrixXd::Zero(at_.size(), at_.size()));
    const auto put = [&](Eigen::Index i, Eigen::Index j, const Vector& values) {
      for (Eigen::Index k = 0; k < values.size(); ++k) {
        Eigen::MatrixXd& matrix = all[static_cast<std::size_t>(k)];
        matrix(i, j) = matrix(j, i) = values[k];
      }
    };
    const auto at = [&](const Moves& moves) { return losses_(moved(moves)); };
    for (Eigen::Index i = 0; i < at_.size(); ++i) {
      put(i, i, (at({{i, 1}}) - 2 * centre_ + at({{i, -1}})) / (step(i) * step(i)));
      for (Eigen::Index j = 0; j < i; ++j) {
        put(i, j,
            (at({{i, 1}, {j, 1}}) - at({{i, 1}, {j, -1}}) - at({{i, -1}, {j, 1}}) + at({{i, -1}, {j, -1}})) /
                (4 * step(i) * step(j)));
      }
    }
    return all;
  }

 private:
  using Moves = std::vector<std::pair<Eigen::Index, double>>;
  [[nodiscard]] double step(Eigen::Index i) const { return derivative_step * steps_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Vector moved(const Moves& moves) const {
    Vector point = at_;
    for (const auto& [i, sign] : moves) point[i] += sign * step(i);
    return point;
  }

  const Losses& losses_;
  const Vector& at_;
  const std::vector<double>& steps_;
  Vector centre_;
};

bool is_positive(const Eigen::LDLT<Eigen::MatrixXd>& factors) {
  return factors.isPositive() && factors.vectorD().minCoeff() > 0;
}

Eigen::MatrixXd jackknife(const Losses& losses, const Vector& at, const std::vector<double>& steps) {
  const Derivatives derivatives(losses, at, steps);
  const Eigen::MatrixXd first = derivatives.first();
  const std::vector<Eigen::MatrixXd> second = derivatives.second();
  const Eigen::Index n = first.rows(), p = first.cols();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(p, p), covariance = sum;
  for (const Eigen::MatrixXd& one : second) sum += one;
  const Eigen::LDLT<Eigen::MatrixXd> all(sum);
  if (!is_positive(all) || n <= p) return Eigen::MatrixXd::Constant(p, p, missing);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::LDLT<Eigen::MatrixXd> others(sum - second[static_cast<std::size_t>(i)]);
    const Vector gradient = first.row(i).transpose();
    const Vector moved = is_positive(others) ? others.solve(gradient) : all.solve(gradient);
    covariance += moved * moved.transpose();
  }
  return covariance * static_cast<double>(n - 1) / static_cast<double>(n);
}

}  // namespace

double pseudo_huber(double r, double s) {
  const double q = r / s;
  return s * s * q * q / (std::sqrt(1 + q * q) + 1);
}

double RobustFit::half_width(int parameter) const {
  const auto freedom = static_cast<double>(losses.size() - value.size());
  if (!(freedom > 0)) return std::numeric_limits<double>::infinity();
  return gsl_cdf_tdist_Pinv(0.975, freedom) * std::sqrt(covariance(parameter, parameter));
}

RobustFit fit_robustly(const Losses& losses, const FitStart& start) {
  RobustFit fit;
  fit.value = least_point(losses, start);
  fit.losses = losses(fit.value);
  fit.covariance = jackknife(losses, fit.value, start.step);
  return fit;
}

PairedDifference paired_difference(const Eigen::VectorXd& a, const Eigen::VectorXd& b) {
  const Vector difference = a - b;
  const auto n = static_cast<double>(difference.size());
  const double mean = difference.mean();
  const double spread = std::sqrt((difference.array() - mean).square().sum() / std::max(1.0, n - 1));
  return {mean, spread / std::sqrt(n)};
}

}  // namespace clatter::validation
