"""Ctrl-C, and what progress raises, end every call soon, whatever it is doing; what it was called on stays usable.

GALE_LONG_INTERRUPTS=140 does it at many moments, on a grid of that size, and prints how late they came."""
import gzip
import os
import pickle
import signal
import struct
import tempfile
import threading
import time
import unittest

import gale
import numpy as np

SIZE = int(os.environ.get("GALE_LONG_INTERRUPTS", "0"))
GRID = SIZE or 44
MOMENTS = np.linspace(0.02, 0.98, 25) if SIZE else (0.1, 0.4)
LATEST = 0.5
TRIES = 4  # others may have the cores meanwhile


def latest(whole):
    """How late the interrupt of a call may come that takes so many seconds: less than what is left of it at most moments."""
    return min(LATEST, 0.1 + 0.2 * whole)


class Raised(Exception):
    pass


class Calls:
    """Each call that may take long, by name: `make()` is what it is called on, new for each."""

    def __init__(self, folder):
        self.mesh, arrays = gale.read(f"grid:{GRID}")
        self.points, self.field = self.mesh.points, arrays["field"]
        self.tetrahedra = self.mesh.relation("TV")[1].reshape(-1, 4)
        self.bytes = pickle.dumps(self.mesh)
        self.image = os.path.join(folder, "image.nii.gz")
        self.write_image()

    def write_image(self):
        header = bytearray(352)
        struct.pack_into("<i", header, 0, 348)
        struct.pack_into("<8h", header, 40, 3, GRID, GRID, GRID, 1, 1, 1, 1)
        struct.pack_into("<2h", header, 70, 16, 32)
        struct.pack_into("<8f", header, 76, 1, 1, 1, 1, 1, 1, 1, 1)
        struct.pack_into("<f", header, 108, 352)
        header[344:348] = b"n+1\0"
        with gzip.open(self.image, "wb", compresslevel=1) as file:
            file.write(bytes(header) + self.field.tobytes())

    def new_mesh(self):
        return gale.Mesh(self.points, self.tetrahedra)

    def by_name(self):
        """name -> (make, call): call(make()) takes long."""
        def nothing():
            return None

        calls = {
            "Mesh": (nothing, lambda _: gale.Mesh(self.points, self.tetrahedra)),
            "Mesh of others": (nothing, lambda _: gale.Mesh(self.points.astype(">f4"), self.tetrahedra.astype(np.uint32))),
            "read a grid": (nothing, lambda _: gale.read(f"grid:{GRID}")),
            "points": (lambda: self.mesh, lambda mesh: mesh.points),
            "pickle": (self.new_mesh, pickle.dumps),
            "unpickle": (nothing, lambda _: pickle.loads(self.bytes)),
        }
        if gale._gale.reads_files:
            calls["read an image"] = (nothing, lambda _: gale.read(self.image))
        for name in "VT", "TT", "VV", "EE", "FF", "TV", "FE", "ET":
            calls[name] = (self.new_mesh, lambda mesh, name=name: mesh.relation(name))
        for name in "critical_points", "critical_simplices", "discrete_gradient", "persistence_diagram", "morse_smale", "merge_tree":
            calls[name] = (self.new_mesh, lambda mesh, name=name: getattr(mesh, name)(self.field))
        calls["simplified"] = (self.new_mesh, lambda mesh: mesh.morse_smale(self.field, persistence="3%"))
        calls["walls"] = (self.new_mesh, lambda mesh: mesh.morse_smale(self.field, separatrices2=True))
        try:
            import pyvista
        except ImportError:
            return calls
        grid = pyvista.UnstructuredGrid({10: self.tetrahedra}, self.points)
        calls["from_pyvista"] = (nothing, lambda _: gale.Mesh.from_pyvista(grid))
        return calls


def lateness(call, seconds):
    """How long after a Ctrl-C, which comes after so many seconds, the call ends by it. None if it ended before."""
    sent = []

    def interrupt():
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(seconds, interrupt)
    try:
        timer.start()
        call()
        done = time.monotonic()
        timer.join()
        time.sleep(0.1)
    except KeyboardInterrupt:
        caught = time.monotonic()
        timer.join()
        return caught - sent[0]
    raise AssertionError(f"no KeyboardInterrupt: {done - sent[0]} s after it was sent")


class Interrupts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.before = signal.signal(signal.SIGINT, signal.default_int_handler)  # some shells ignore it
        cls.folder = tempfile.TemporaryDirectory()
        cls.calls = Calls(cls.folder.name)

    @classmethod
    def tearDownClass(cls):
        signal.signal(signal.SIGINT, cls.before)
        cls.folder.cleanup()

    def test_none_comes_late(self):
        for name, (make, call) in self.calls.by_name().items():
            on = make()
            begin = time.monotonic()
            call(on)
            whole = time.monotonic() - begin
            if whole < 0.3:  # it would be over
                continue
            late = []
            for moment in MOMENTS:
                for left in reversed(range(TRIES)):
                    on = make()
                    late.append(lateness(lambda: call(on), moment * whole))
                    if late[-1] < latest(whole) or left == 0:
                        break
                    late.pop()
            if SIZE:
                print(f"{name}: {whole:.2f} s, interrupts come {max(late):.2f} s late, "
                      f"{sorted(late)[len(late) // 2]:.2f} s in the middle", flush=True)
            with self.subTest(name):
                self.assertLess(max(late), latest(whole))

    def test_nothing_goes_on_in_the_background(self):
        mesh = self.calls.new_mesh()
        lateness(lambda: mesh.morse_smale(self.calls.field), 0.1)
        before = time.process_time()
        time.sleep(0.3)
        self.assertLess(time.process_time() - before, 0.1)

    def test_what_was_interrupted_stays_usable(self):
        expected = self.calls.mesh.persistence_diagram(self.calls.field)
        mesh = self.calls.new_mesh()
        for seconds in (0, 0.02, 0.1, 0.3):
            for call in (lambda: mesh.relation("FF"), lambda: mesh.morse_smale(self.calls.field, persistence="3%")):
                lateness(call, seconds)
        self.assertEqual(mesh.persistence_diagram(self.calls.field), expected)
        for a, b in zip(mesh.relation("FE"), self.calls.mesh.relation("FE")):
            np.testing.assert_array_equal(a, b)

    def test_what_progress_raises_ends_every_call(self):
        mesh, field = self.calls.new_mesh(), self.calls.field
        for call in (lambda **to: mesh.relation("VT", **to), lambda **to: mesh.relation("VV", **to),
                     lambda **to: mesh.relation("EE", **to), lambda **to: mesh.critical_points(field, **to),
                     lambda **to: mesh.critical_simplices(field, **to), lambda **to: mesh.discrete_gradient(field, **to),
                     lambda **to: mesh.persistence_diagram(field, **to), lambda **to: mesh.morse_smale(field, **to)):
            for after in (0, 1, 3):
                raised, calls = [], []

                def tell(done, of):
                    self.assertIs(threading.current_thread(), threading.main_thread())
                    calls.append(done)
                    if len(calls) > after:
                        raised.append(time.monotonic())
                        raise Raised

                try:
                    call(progress=tell)
                except Raised:
                    self.assertLess(time.monotonic() - raised[0], LATEST)
                else:  # a fast one, which doesn't ask so often
                    self.assertGreater(after, 0)
                    self.assertLessEqual(len(calls), after)
                    continue
                self.assertEqual((len(raised), len(calls)), (1, after + 1))

    def test_handlers_that_raise_nothing_let_it_go_on(self):
        handled = []
        before = signal.signal(signal.SIGINT, lambda *_: handled.append(1))
        try:
            timer = threading.Timer(0.05, os.kill, (os.getpid(), signal.SIGINT))
            timer.start()
            found = self.calls.new_mesh().critical_simplices(self.calls.field)
            timer.join()
        finally:
            signal.signal(signal.SIGINT, before)
        self.assertEqual(handled, [1])
        self.assertEqual(found, self.calls.mesh.critical_simplices(self.calls.field))

    def test_a_callback_may_call(self):
        mesh, counts = self.calls.mesh, []
        mesh.critical_points(self.calls.field,
                             progress=lambda done, of: counts or counts.append(len(mesh.relation("TV")[1])))
        self.assertEqual(counts, [4 * mesh.tetrahedra])


if __name__ == "__main__":
    unittest.main()
