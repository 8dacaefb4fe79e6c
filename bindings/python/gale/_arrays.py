"""Arrays of callers as GALE reads them: where they are, if their types and layouts allow it."""
from __future__ import annotations

from typing import Any, List, Tuple

import numpy as np

from . import _gale
from ._gale import Error

_HOST = (1, 3)  # DLPack's codes of host memory, and of host memory that CUDA knows
_AT_ONCE = 1 << 20  # rows that are converted between two looks at whether the user has interrupted


def _device_array(array: Any) -> Any:
    """The array by DLPack if a device has it, else None."""
    if hasattr(array, "__dlpack_device__"):
        return None if array.__dlpack_device__()[0] in _HOST else array
    if not hasattr(array, "__cuda_array_interface__"):
        return None
    given = array.__cuda_array_interface__
    order, kind, size = given["typestr"][0], given["typestr"][1], int(given["typestr"][2:])
    if kind not in "iuf" or order == ">":
        raise Error(f"an array of {given['typestr']} on a device is not one of numbers in the machine's order")
    expected = [size * int(np.prod(given["shape"][d + 1:])) for d in range(len(given["shape"]))]
    if given.get("strides") is not None and list(given["strides"]) != expected:
        raise Error(f"the rows of an array on a device don't follow each other: its strides are {given['strides']}")
    return _gale.device_array(given["data"][0], list(given["shape"]), kind, size, array)


def _host_array(array: Any) -> np.ndarray:
    if np.ma.is_masked(array):
        raise Error("some values of an array are masked: fill them first")
    is_numpys = hasattr(array, "__array__") or hasattr(array, "__array_interface__") or not hasattr(array, "__dlpack__")
    try:
        return np.asarray(array) if is_numpys else np.from_dlpack(array)
    except (BufferError, RuntimeError, TypeError, ValueError) as error:
        raise Error(f"what is no array can't be read as one: {error}") from error


def _converted(array: np.ndarray, dtype: np.dtype) -> np.ndarray:
    """The array itself if it is of that type and its rows follow each other, else a copy."""
    if array.dtype == dtype and array.flags.c_contiguous:
        return array
    if array.ndim == 0:
        return array.astype(dtype)
    copy = np.empty(array.shape, dtype)
    for begin in range(0, len(array), _AT_ONCE):
        copy[begin:begin + _AT_ONCE] = array[begin:begin + _AT_ONCE]
    return copy


class _Piece:
    """Some rows of an array to be pickled: Python looks for interrupts between two of them, and not within an array."""

    def __init__(self, rows: np.ndarray) -> None:
        self._rows = rows

    def __reduce__(self) -> Tuple[Any, ...]:
        return _rows_of, (self._rows,)


def _rows_of(rows: np.ndarray) -> np.ndarray:
    return rows


def pieces(array: np.ndarray) -> List[_Piece]:
    """What is pickled in place of an array, and unpickled as what `joined` takes."""
    return [_Piece(array[begin:begin + _AT_ONCE]) for begin in range(0, len(array), _AT_ONCE)]


def joined(parts: List[np.ndarray]) -> np.ndarray:
    whole = np.empty((sum(map(len, parts)), *parts[0].shape[1:]), parts[0].dtype)
    begin = 0
    for part in parts:
        whole[begin:begin + len(part)] = part
        begin += len(part)
    return whole


def points(array: Any) -> Any:
    """As float32 or float64."""
    on_device = _device_array(array)
    if on_device is not None:
        return on_device
    array = _host_array(array)
    if array.dtype.kind not in "iuf":
        raise Error(f"points of {array.dtype} are not numbers")
    return _converted(array, np.dtype(np.float32 if array.dtype == np.float32 else np.float64))


def _require_64_bits(array: np.ndarray, have: str) -> None:
    if array.dtype == np.uint64 and array.size > 0 and array.max() > np.iinfo(np.int64).max:
        raise Error(f"{have} {array.max()}, which is too large for any mesh")


def ids(array: Any, name: str = "tetrahedra") -> Any:
    """As int32 or int64, from any integers."""
    on_device = _device_array(array)
    if on_device is not None:
        return on_device
    array = _host_array(array)
    if array.dtype.kind not in "iu":
        raise Error(f"{name} of {array.dtype} are not integers: they are ids of vertices, numbers of points from 0")
    _require_64_bits(array, f"{name} have a vertex")
    return _converted(array, np.dtype(np.int32 if array.dtype == np.int32 else np.int64))


def offsets(array: Any) -> Any:
    """As int64, from any integers."""
    return _int64(array, "offsets", "they say where each cell begins")


def global_ids(array: Any, name: str) -> Any:
    """As int64, from any integers; or from nothing, whatever its type."""
    return _int64(np.zeros(np.shape(array), np.int64) if np.size(array) == 0 else array, name, "they are global ids")


def _int64(array: Any, name: str, meaning: str) -> Any:
    array = _host_array(array)
    if array.dtype.kind not in "iu":
        raise Error(f"{name} of {array.dtype} are not integers: {meaning}")
    _require_64_bits(array, f"{name} have")
    return _converted(array, np.dtype(np.int64))


def types(array: Any) -> Any:
    """As uint8, from any integers."""
    array = _host_array(array)
    if array.dtype.kind not in "iu":
        raise Error(f"types of {array.dtype} are not integers: they are VTK's numbers")
    if array.size > 0 and not 0 <= array.min() <= array.max() <= 255:
        wrong = array[(array < 0) | (array > 255)][0]
        raise Error(f"one of the types is {wrong}, which is none of VTK's")
    return _converted(array, np.dtype(np.uint8))


def field(values: Any) -> Any:
    """As one of the types that GALE has fields of."""
    on_device = _device_array(values)
    if on_device is not None:
        return on_device
    values = _host_array(values)
    if values.dtype == np.bool_:
        values = values.view(np.uint8)
    if values.dtype.kind not in "iuf" or values.dtype.itemsize > 8:
        raise Error(f"a field of {values.dtype} is not one of numbers of up to 8 bytes")
    return _converted(values, np.dtype(np.float32) if values.dtype == np.float16 else values.dtype.newbyteorder("="))
