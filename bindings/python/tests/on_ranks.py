"""What test_ranks.py runs under mpirun: what a gale.DistributedMesh finds is what a gale.Mesh finds of the whole."""
import sys

import gale
import numpy as np
from meshes import random_mesh
from mpi4py import MPI

COMM = MPI.COMM_WORLD


def fail(why):
    """Ends all ranks: one that ends by itself would wait for the others."""
    print(why, file=sys.stderr, flush=True)
    COMM.Abort(1)


def check(holds, why):
    if not holds:
        fail(why)


def rows(*columns):
    """Their entries side by side, from all ranks, sorted."""
    parts = COMM.gather(np.column_stack([np.asarray(column, np.float64) for column in columns]))
    if parts is None:
        return None
    whole = np.concatenate(parts)
    return whole[np.lexsort(whole.T[::-1])]


def same(name, found, expected):
    if COMM.rank == 0 and not np.array_equal(found, expected):
        fail(f"{name}: {found} is not {expected}")


def sorted_rows(*columns):
    whole = np.column_stack([np.asarray(column, np.float64) for column in columns])
    return whole[np.lexsort(whole.T[::-1])]


points, tetrahedra, field = random_mesh(3, 6)
for values, repartition in ((field, False), (np.round(field), True), (field.astype(np.float32), False)):
    cells = np.flatnonzero(np.random.default_rng(7).integers(0, COMM.size, len(tetrahedra)) == COMM.rank)
    own = tetrahedra[cells]
    ids = np.unique(own)
    part = gale.DistributedMesh(COMM, ids, points[ids], own, cells, repartition)
    whole = gale.Mesh(points, tetrahedra)
    check((part.vertices, part.tetrahedra, part.dimension) == (len(points), len(tetrahedra), 3), "sizes")
    check(np.array_equal(part.points, points[part.vertex_ids]), "points")

    found, expected = part.critical_points(values[ids]), whole.critical_points(values)
    named = ["ttkVertexScalarField", "CriticalType", "IsOnBoundary"]
    same("critical points", rows(found.points, *[found[name] for name in named]),
         sorted_rows(expected.points, *[expected[name] for name in named]))
    found, expected = part.critical_simplices(values[ids]), whole.critical_simplices(values)
    named = ["CellId", "CellDimension", "ttkVertexScalarField"]
    same("critical simplices", rows(*[found[name] for name in named]), sorted_rows(*[expected[name] for name in named]))

    found, expected = part.persistence_diagram(values[ids], "2%"), whole.persistence_diagram(values, "2%")
    check(found == expected if COMM.rank == 0 else len(found.birth) == 0, "diagrams differ")

    found, expected = part.morse_smale(values[ids], separatrices2=True), whole.morse_smale(values, separatrices2=True)
    named = ["SourceId", "SeparatrixId", "SeparatrixFunctionMaximum", "SeparatrixFunctionMinimum", "NumberOfCriticalPointsOnBoundary"]
    walls, all_walls = found.separatrices2.cell_arrays, expected.separatrices2.cell_arrays
    same("walls", rows(*[walls[name] for name in named]), sorted_rows(*[all_walls[name] for name in named]))
    named = ["SourceId", "DestinationId", "SeparatrixType"]
    lines, all_lines = found.separatrices1.cell_arrays, expected.separatrices1.cell_arrays
    same("separatrices", rows(*[lines[name] for name in named]), sorted_rows(*[all_lines[name] for name in named]))
    own_vertices = part.owners == COMM.rank
    for name in ("AscendingManifold", "DescendingManifold", "MorseSmaleManifold"):
        same(name, rows(part.vertex_ids[own_vertices], found.manifolds[name][own_vertices]),
             sorted_rows(np.arange(len(points)), expected.manifolds[name]))

    found, expected = part.merge_tree(values[ids], arc_samples=2), whole.merge_tree(values, arc_samples=2)
    check(COMM.rank != 0 or np.array_equal(found.nodes.points, expected.nodes.points), "nodes")
    check(COMM.rank != 0 or np.array_equal(found.arcs.points, expected.arcs.points), "points of arcs")
    check(COMM.rank == 0 or (len(found.nodes["Scalar"]), len(found.arcs.cell_arrays["upNodeId"])) == (0, 0), "nodes elsewhere")
    same("arcs", rows(part.vertex_ids[own_vertices], found.segmentation["SegmentationId"][own_vertices]),
         sorted_rows(np.arange(len(points)), expected.segmentation["SegmentationId"]))

    found, expected = part.simplify_field(values[ids], "20%"), whole.simplify_field(values, "20%")
    check((found.minima, found.maxima) == (expected.minima, expected.maxima), "simplified extrema")
    for name in ("values", "order"):
        check(np.array_equal(getattr(found, name), getattr(expected, name)[part.vertex_ids]), f"simplified {name}")
    simple, order = expected.values, expected.order
    found, expected = part.persistence_diagram(simple[ids], order=order[ids]), whole.persistence_diagram(simple, order=order)
    check(found == expected if COMM.rank == 0 else len(found.birth) == 0, "diagrams along an order")
    found, expected = part.merge_tree(simple[ids], order=order[ids]), whole.merge_tree(simple, order=order)
    check(COMM.rank != 0 or np.array_equal(found.nodes.points, expected.nodes.points), "nodes along an order")
    found, expected = part.merge_tree(values[ids], persistence="20%"), whole.merge_tree(values, persistence="20%")
    check(COMM.rank != 0 or np.array_equal(found.nodes.points, expected.nodes.points), "nodes of a simplified field")

for wrong in (lambda: part.relation("VV"), lambda: gale.DistributedMesh(1, [], [], []),
              lambda: gale.DistributedMesh(MPI.COMM_NULL, [], [], []),
              lambda: part.critical_points(values[ids][1:])):
    try:
        wrong()
    except gale.Error:
        continue
    fail("no error")


def expect(call, naming):
    """What is wrong on the last rank alone ends all of them alike."""
    try:
        call()
    except (gale.Error if COMM.size > 1 else Exception) as error:
        text = str(error)
        check(naming in text and COMM.allgather(text) == [text] * COMM.size, text)
        return
    fail(f"no error that has {naming}")


is_last = COMM.rank == COMM.size - 1
own = values[ids]
for call, naming in (
        (lambda: part.critical_points(np.array(["no"] * len(ids)) if is_last else own), ""),
        (lambda: part.critical_points(np.ma.masked_all(len(ids)) if is_last else own), "masked"),
        (lambda: part.critical_points(own, threads=-1 if is_last else 1), "-1"),
        (lambda: part.critical_points(own, threads="two" if is_last else 1), ""),
        (lambda: part.critical_points(own, order=ids[:, None] if is_last else ids), "the order has 2 dimensions"),
        (lambda: part.critical_points(own, order=ids - 1), "vertex 0 has -1"),
        (lambda: part.persistence_diagram(own, "much" if is_last else "2%"), "much"),
        (lambda: part.critical_points(*[own][is_last:]), "field"),
        (lambda: gale.DistributedMesh(COMM, ids / 2 if is_last else ids, points[ids], []), "integers"),
        (lambda: gale.DistributedMesh(COMM, ids.astype(np.uint64) + np.uint64(2**63) * is_last, points[ids], []), "too large"),
        (lambda: gale.DistributedMesh(COMM, np.ma.masked_all(len(ids), int) if is_last else ids, points[ids], []), "masked"),
        (lambda: gale.DistributedMesh(COMM, ids, points[ids], [], repartition="no" if is_last else True), "'no'"),
        (lambda: gale.DistributedMesh(COMM, ids, points[ids], [], capacity="no" if is_last else 64), "'no'")):
    expect(call, naming)
if COMM.size > 1:
    expect(lambda: part.morse_smale(own, separatrices2=is_last), "different things")
    expect(lambda: part.merge_tree(own, order=ids if is_last else None), "different things")
    expect(lambda: part.merge_tree(own, "join" if is_last else "split"), "different things")
    expect(lambda: part.merge_tree(own) if is_last else part.critical_points(own), "different things")


def give_up(done, of_all):
    raise ValueError("enough")


for _ in range(20):  # until a short run tells its progress
    try:
        part.morse_smale(own, progress=give_up if COMM.rank == 0 else None)
    except (gale.Error, ValueError) as error:
        check(str(error) == ("enough" if COMM.rank == 0 else "rank 0: the computation was asked to stop"), error)
        break
else:
    fail("not stopped")
nobody = values[ids] if COMM.rank else values[ids].astype(np.float64)
try:
    part.critical_points(nobody)
    check(COMM.size == 1, "fields of two types")
except gale.Error as error:
    check("another type on other ranks" in str(error), error)
print("equal", flush=True)
