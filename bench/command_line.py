"""What the programs here share as programs: one line for each error, exit code 2 for bad input."""
from __future__ import annotations

import argparse
import os
import sys
from typing import Callable, NoReturn


class BadInput(Exception):
    """A file or an argument that cannot be used. Its text is the whole message."""


class Parser(argparse.ArgumentParser):
    """Tells a wrong argument in one line, in place of a page of usage before it."""

    def error(self, message: str) -> NoReturn:
        raise BadInput(f"{message}; see {self.prog} --help")


def run_main(main: Callable[[], int]) -> NoReturn:
    """Runs `main`, turns bad input into `error: ...` with exit code 2, and ends the program."""
    try:
        status = main()
        sys.stdout.flush()
        sys.exit(status)
    except BadInput as error:
        print(f"error: {error}", file=sys.stderr)
        sys.exit(2)
    except BrokenPipeError:  # `| head` has seen enough
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(0)
    except OSError as error:
        print(f"error: {error.filename}: {error.strerror}", file=sys.stderr)
        sys.exit(2)
