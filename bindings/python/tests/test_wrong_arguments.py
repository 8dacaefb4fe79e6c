"""Every public function with wrong arguments of every kind: gale.Error, TypeError or ValueError, and nothing else."""
import inspect
import os
import pathlib
import tempfile
import types
import unittest

import gale
import numpy as np
from meshes import random_mesh

POINTS, TETRAHEDRA, FIELD = random_mesh(1)
UNDECODABLE = "\udc80"


def changed(array, place, value):
    copy = np.array(array)
    copy[place] = value
    return copy


NO_ARRAYS = [None, object(), "x", 3, {}, [[1, 2], [3]], np.array(["x"]), np.array(3)]
NOT_THREADS = [-1, 1025, 10**9, 10**30, 1.5, "x", None]

# By parameter: what none may be, whatever the function.
WRONG = {
    "points": NO_ARRAYS + [[], POINTS[:, :2], POINTS.ravel(), POINTS * 1j, POINTS.astype(str), POINTS.astype(object),
                           changed(POINTS, (3, 1), np.nan), changed(POINTS, (3, 1), np.inf), POINTS > 0,
                           np.ma.masked_less(POINTS, 1), POINTS[:5]],
    "cells": NO_ARRAYS + [[], TETRAHEDRA[:, :2], TETRAHEDRA.ravel(), TETRAHEDRA.astype(float), TETRAHEDRA * 1j,
                               TETRAHEDRA.astype(object), TETRAHEDRA > 0, changed(TETRAHEDRA, (2, 3), -1),
                               changed(TETRAHEDRA, (2, 3), 64), changed(TETRAHEDRA, (2, 3), 2**40),
                               changed(TETRAHEDRA, 2, 7), changed(TETRAHEDRA, 5, TETRAHEDRA[4]), TETRAHEDRA[:0],
                               changed(TETRAHEDRA.astype(np.uint64), (2, 3), 2**63 + 1),
                               np.ma.masked_less(TETRAHEDRA, 1)],
    "capacity": [0, -1, 1.5, "x", None, 2**31, 10**30],
    "field": NO_ARRAYS + [[], FIELD[1:], FIELD.reshape(8, 8), FIELD * np.nan, FIELD * 1j, FIELD.astype(str),
                          FIELD.astype(object), FIELD.astype(np.longdouble), np.ma.masked_less(FIELD, 0),
                          FIELD.astype("datetime64[s]")],
    "threads": NOT_THREADS,
    "progress": [5, "x", object(), []],
    "order": ["x", object(), 3, [0, 0], np.arange(len(FIELD))[:, None], np.zeros(len(FIELD)), -np.arange(len(FIELD)),
              np.arange(len(FIELD)) + 1, np.arange(len(FIELD)) + 0.5, np.full(len(FIELD), np.nan)],
    "persistence": ["x%", "3", "", "%", "nan%", "-3%", -1, np.nan, object(), [1, 2], 1j, b"3%", 10**400],
    "extrema_only": ["x", object()],
    "separatrices2": ["x", object()],
    "path": [None, 3, "", "missing.vtu", "missing.unknown", "grid:", "grid:x", "grid:1", "grid:-9", "grid:9\0", "a\0b.vtu",
             b"missing.vtu", b"\xff.vtu", UNDECODABLE + ".vtu", os.devnull, tempfile.gettempdir(), "grid:" + 30 * "9"],
    "above": ["x", object(), [1], 0.5],  # a mesh has no threshold
    "array": [3, object(), "missing", UNDECODABLE],
    "outside_files": ["x", object()],
    "type": [3, None, "", "oak", UNDECODABLE], "arc_samples": [-1, None, "x", 1.5, 2 ** 40, object()],
}
NAMES = [3, None, b"x", UNDECODABLE]
NOT_RELATIONS = [3, None, "", "V", "vt", "VX", "VVV", "VT\0", UNDECODABLE]
OF_FIELDS = {"field": FIELD}

MESH = gale.Mesh(POINTS, TETRAHEDRA)

# By function: arguments that are right, and names that are wrong.
FUNCTIONS = {
    gale.Mesh: ({"points": POINTS, "cells": TETRAHEDRA}, []),
    gale.read: ({"path": "grid:4"}, []),
    MESH.relation: ({"name": "VT"}, NOT_RELATIONS),
    MESH.relation_matrix: ({"name": "VT"}, NOT_RELATIONS),
    MESH.critical_points: (OF_FIELDS, NAMES + ["CriticalType", "IsOnBoundary", "ttkVertexScalarField"]),
    MESH.critical_simplices: (OF_FIELDS, NAMES + ["CellDimension", "CellId"]),
    MESH.discrete_gradient: (OF_FIELDS, NAMES + ["CellDimension", "IsOnBoundary"]),
    MESH.persistence_diagram: (OF_FIELDS, NAMES),
    MESH.morse_smale: (OF_FIELDS, NAMES + ["CellId"]),
    MESH.merge_tree: (OF_FIELDS, NAMES + ["NodeId", "VertexId"]),
    MESH.simplify_field: (OF_FIELDS, NAMES),
}


class WrongArguments(unittest.TestCase):
    def refused(self, call, words="."):
        try:
            call()
        except (gale.Error, TypeError, ValueError) as error:
            self.assertRegex(str(error), words)
            if type(error) is ValueError:
                self.fail(f"a ValueError that isn't a gale.Error: {error}")
        else:
            self.fail("nothing was raised")

    def test_no_function_takes_any(self):
        for function, (right, wrong_names) in FUNCTIONS.items():
            for name in inspect.signature(function).parameters:
                for wrong in wrong_names if name == "name" else WRONG[name]:
                    with self.subTest(function=function, name=name, wrong=wrong):
                        if function == MESH.relation_matrix:
                            self.needs_scipy()
                        self.refused(lambda: function(**{**right, name: wrong}))
            if function != MESH.relation_matrix:
                function(**right)

    def needs_scipy(self):
        try:
            import scipy.sparse
        except ImportError:
            self.skipTest("there is no scipy")

    def test_all_functions_are_here(self):
        public = {name for name, _ in inspect.getmembers(gale.Mesh, inspect.isroutine) if not name.startswith("_")}
        self.assertEqual(public - {"from_cells", "from_meshio", "from_pyvista", "to_pyvista"},
                         {function.__name__ for function in FUNCTIONS} - {"Mesh", "read"})

    def test_grids_that_are_none(self):
        for wrong in (None, 3, "x", object(), POINTS, {}, MESH):
            self.refused(lambda: gale.Mesh.from_pyvista(wrong), "is no grid")

    def test_grids_that_do_not_fit(self):
        try:
            import pyvista
        except ImportError:
            self.skipTest("there is no pyvista")
        line, row = pyvista.Line(), pyvista.ImageData(dimensions=(3, 1, 1))
        lines = row.cast_to_unstructured_grid()
        five = pyvista.UnstructuredGrid()
        five.points = POINTS
        five.SetCells(10, pyvista.CellArray([5, 0, 1, 2, 3, 4, 3, 5, 6, 7]))
        pointless = pyvista.UnstructuredGrid()
        for wrong in (line, row, lines, five, pointless, pyvista.MultiBlock([lines]), line.points):
            with self.subTest(wrong=type(wrong)):
                self.refused(lambda: gale.Mesh.from_pyvista(wrong), "grid|cell|has no polygons|has no tetrahedra")
        if hasattr(pyvista, "register_dataset_accessor"):
            grid = pyvista.UnstructuredGrid({10: TETRAHEDRA}, POINTS)
            grid["height"] = FIELD
            for wrong in ("width", 3, None, UNDECODABLE):
                for function in (grid.gale.critical_points, grid.gale.critical_simplices, grid.gale.persistence_diagram,
                                 grid.gale.morse_smale, grid.gale.merge_tree, grid.gale.simplify_field):
                    self.refused(lambda: function(wrong), "it has height$")

    def test_types_are_named_in_a_line(self):
        mesh = gale.Mesh(POINTS, TETRAHEDRA)
        for wrong, says in (({"threads": 2.0}, "threads is 2.0, which is no whole number"), ({"name": 3}, "name is 3, which is no str"),
                            ({"extrema_only": 1}, "extrema_only is 1, neither True nor False")):
            with self.assertRaises(TypeError) as caught:
                mesh.morse_smale(FIELD, **wrong)
            self.assertEqual(str(caught.exception), says)
        mesh.morse_smale(FIELD, extrema_only=np.True_)
        with self.assertRaisesRegex(TypeError, "step 0, of tuple, is not"):
            gale.track([(0, POINTS, FIELD)])
        with self.assertRaisesRegex(gale.Error, "the time of step 1, 0, is before that of the last one, 1.0"):
            gale.track([(1, mesh, FIELD), (0, mesh, FIELD)])
        for wrong in (lambda: mesh.relation("VT", threads=2.0), lambda: gale.track([(0, mesh, FIELD)], threads=2.0),
                      lambda: gale.Mesh.from_cells(POINTS, TETRAHEDRA[:2].ravel(), [0, 4, 8], [10, 10], capacity=2.0)):
            with self.assertRaisesRegex(TypeError, "is 2.0, which is no whole number"):
                wrong()
        with self.assertRaisesRegex(gale.Error, "threads is 1099511627776, which 32 bits don't hold"):
            mesh.critical_points(FIELD, threads=2**40)
        with self.assertRaisesRegex(gale.Error, "finite"):
            gale.track([(np.nan, mesh, FIELD)])
        meshios = types.SimpleNamespace(points=POINTS, cells=[types.SimpleNamespace(type="tetra", data=TETRAHEDRA + 0.7)])
        with self.assertRaisesRegex(gale.Error, "cells of meshio's type 'tetra' of float64 are not integers"):
            gale.Mesh.from_meshio(meshios)
        with self.assertRaisesRegex(gale.Error, "offsets have 18446744073709551615, which is too large"):
            gale.Mesh.from_cells(POINTS, TETRAHEDRA[:2].ravel(), np.array([0, 4, 2**64 - 1], np.uint64), [10, 10])

    def test_unknown_names_say_which_there_are(self):
        found = MESH.morse_smale(FIELD, separatrices2=True)
        for result in (found, found.critical_points, found.separatrices1, found.separatrices2, MESH.critical_points(FIELD),
                       MESH.discrete_gradient(FIELD), MESH.persistence_diagram(FIELD)):
            for wrong in ("missing", 0, None):
                with self.assertRaisesRegex(gale.Error, f"^there is no '{wrong}' here, but {', '.join(result)}$"):
                    result[wrong]
        with self.assertRaisesRegex(gale.Error, "^grid:4 has no point array 'missing': it has field$"):
            gale.read("grid:4", array="missing")

    @unittest.skipUnless(gale._gale.reads_files, "this gale reads no files")
    def test_files_whose_names_and_arrays_are_any_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(os.fsencode(folder), b"caf\xe9.vtk")
            lines = [b"# vtk DataFile Version 3.0", b"x", b"ASCII", b"DATASET UNSTRUCTURED_GRID", b"POINTS 4 float",
                     b"0 0 0 1 0 0 0 1 0 0 0 1", b"CELLS 1 5", b"4 0 1 2 3", b"CELL_TYPES 1", b"10", b"POINT_DATA 4",
                     b"SCALARS h\xf6he float 1", b"LOOKUP_TABLE default", b"0 1 2 3"]
            pathlib.Path(os.fsdecode(path)).write_bytes(b"\n".join(lines) + b"\n")
            for name in (path, os.fsdecode(path), pathlib.Path(os.fsdecode(path))):
                mesh, arrays = gale.read(name)
                self.assertEqual((mesh.tetrahedra, list(arrays)), (1, ["h\\xf6he"]))
            with self.assertRaisesRegex(gale.Error, "h\\\\xf6he"):
                gale.read(path, array="missing")
            pathlib.Path(os.fsdecode(path)).write_bytes(b"\n".join(lines[:-1]) + b"\n")
            with self.assertRaisesRegex(gale.Error, r"caf\\xe9"):
                gale.read(path)


if __name__ == "__main__":
    unittest.main()
