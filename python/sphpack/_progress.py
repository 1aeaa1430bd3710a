"""How far a packing is: with tqdm where it is installed, else in lines."""

from __future__ import annotations

import sys
import time
from collections.abc import Callable
from typing import Any

News = dict[str, Any]
"""How far a packing is: stage, evaluation, max_evaluations, criterion, tolerance, on_surface, target, seconds."""

Listener = Callable[[News], Any]


class _Lines:
    """A line every two seconds."""

    def __init__(self) -> None:
        self._last = time.monotonic()

    def __call__(self, news: News) -> None:
        now = time.monotonic()
        if now - self._last >= 2.0:
            self._last = now
            print(_words(news), file=sys.stderr, flush=True)

    def close(self) -> None:
        pass


class _Bar:
    """One of tqdm's, of evaluations. How many it will take is not known before."""

    def __init__(self, tqdm: Any) -> None:
        self._bar = tqdm(unit=" evaluations", desc="packing")

    def __call__(self, news: News) -> None:
        self._bar.update(news["evaluation"] - self._bar.n)
        self._bar.set_postfix_str(_words(news), refresh=False)

    def close(self) -> None:
        self._bar.close()


def _words(news: News) -> str:
    words = str(news["stage"])
    if news["evaluation"]:
        words += f", {news['criterion']:.1e} of {news['tolerance']:.1e}"
    if news["target"]:
        words += f", {news['on_surface']} of {news['target']} on surfaces"
    return words


def listener(progress: bool | Listener | None) -> Listener | None:
    """Who is told: nobody, a function, or whoever shows it best."""
    if not progress:
        return None
    if callable(progress):
        return progress
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _Lines()
    return _Bar(tqdm)
