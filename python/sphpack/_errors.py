"""What can go wrong. The words are those of the command."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._particles import Particles


class Error(Exception):
    """Something that cannot be foreseen: a full disk, memory that the machine does not have."""

    def __init__(self, message: str, status: int = 1) -> None:
        super().__init__(message)
        self.status = status
        """The exit status with which the command ends for this."""


class InputError(Error, ValueError):
    """The input is wrong; the message says what, where, and the cure."""

    def __init__(self, message: str, status: int = 2) -> None:
        super().__init__(message, status)


class Interrupted(KeyboardInterrupt):
    """Ctrl-C while particles settled."""

    def __init__(self, particles: Particles) -> None:
        super().__init__("stopped; what there is, not settled, is in .particles")
        self.particles = particles
        """What there was, marked as not settled."""


class NotSettled(UserWarning):
    """A packing that has not reached its tolerance, or that the audit does not pass."""
