"""The command ``sphpack``."""

import sys

from . import _native


def main() -> None:
    sys.exit(_native.command(["sphpack", *sys.argv[1:]]))
