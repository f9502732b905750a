# SPDX-License-Identifier: GPL-3.0-or-later
"""What can go wrong, and the exit status that the program would have."""


class Error(Exception):
    """Any error of clatter."""


class BadInput(Error, ValueError):
    """What was given cannot be used: which argument or key, its value, what is allowed (exit status 2)."""


class BadArgument(BadInput, TypeError):
    """An argument that a function does not have, or of a type that it has no use for."""


class NotComputed(Error, ArithmeticError):
    """A number could not be computed (exit status 3)."""


class OutsideModel(Error):
    """The scene is outside the range of the model, jamming say (exit status 4)."""


class ClatterWarning(UserWarning):
    """A result with a reservation: energy that an impulse ratio creates, a run that ended early."""
