"""Which interpreter of the process this is."""
import importlib


def require_main() -> None:
    """Raises ImportError in a subinterpreter: Kokkos, numpy and nanobind are there once in a process."""
    for name in "_interpreters", "_xxsubinterpreters":  # since Python 3.13, and before
        try:
            interpreters = importlib.import_module(name)
        except ImportError:
            continue
        if interpreters.get_current() != interpreters.get_main():
            raise ImportError("gale can't be imported in a subinterpreter: use it in the main one, or in a process of its own")
        return
