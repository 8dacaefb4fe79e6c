"""Progress: a function of the caller's, or a bar of tqdm's."""
from __future__ import annotations

from contextlib import contextmanager
from typing import Any, Callable, Iterator, Optional, Union

import numpy as np

Progress = Union[bool, Callable[[int, int], Any], None]


@contextmanager
def told(progress: Progress, title: str) -> Iterator[Optional[Callable[[int, int], Any]]]:
    """What C++ calls with how much is done, of how much: `progress` itself, or for True what moves a bar."""
    if progress is None or progress is False or callable(progress):
        yield progress or None
        return
    if not isinstance(progress, (bool, np.bool_)):
        raise TypeError(f"progress is {progress!r}: neither a function nor True")
    try:
        from tqdm.auto import tqdm
    except ImportError:
        yield None
        return
    with tqdm(desc=title, unit="segment") as bar:
        def move(done: int, of: int) -> None:
            if done < bar.n:  # the next sweep
                bar.reset()
            bar.total = of
            bar.update(done - bar.n)

        yield move
