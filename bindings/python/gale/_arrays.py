"""Arrays of callers as GALE reads them: where they are, if their types and layouts allow it."""
from __future__ import annotations

from typing import Any

import numpy as np

from . import _gale
from ._gale import Error

_HOST = (1, 3)  # DLPack's codes of host memory, and of host memory that CUDA knows


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
    is_numpys = hasattr(array, "__array__") or hasattr(array, "__array_interface__") or not hasattr(array, "__dlpack__")
    return np.asarray(array) if is_numpys else np.from_dlpack(array)


def rows(array: Any, kinds: tuple[type, ...], default: type) -> Any:
    """The array itself, if its type is one of `kinds` and its rows follow each other; else a copy of type `default`.
    What a device has stays as it is."""
    on_device = _device_array(array)
    if on_device is not None:
        return on_device
    array = _host_array(array)
    if array.dtype not in kinds:
        if not (np.issubdtype(array.dtype, np.integer) or np.issubdtype(array.dtype, np.floating)):
            raise Error(f"an array of {array.dtype} is not one of numbers")
        array = array.astype(default)
    return np.ascontiguousarray(array)


def field(values: Any) -> Any:
    """The values as one of the types that GALE has fields of. What a device has stays as it is."""
    on_device = _device_array(values)
    if on_device is not None:
        return on_device
    values = _host_array(values)
    if values.dtype == np.bool_:
        values = values.view(np.uint8)
    elif values.dtype == np.float16:
        values = values.astype(np.float32)
    elif values.dtype.kind not in "iuf" or values.dtype.itemsize > 8:
        raise Error(f"a field of {values.dtype} is not one of numbers of up to 8 bytes")
    return np.ascontiguousarray(values.astype(values.dtype.newbyteorder("="), copy=False))
