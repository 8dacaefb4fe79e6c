"""gale relations: rows by definition, the same whatever the structure and the segments; verification; what it refuses."""
import itertools
import unittest
from pathlib import Path

import gale

DIMENSION = {"V": 0, "E": 1, "F": 2, "T": 3}
RELATIONS = ["EV", "FV", "FE", "TV", "TE", "TF", "VE", "VF", "VT", "EF", "ET", "FT", "VV", "EE", "FF", "TT"]
BRAIN = Path("/usr/share/mricron/templates/inia19-t1-brain.nii.gz")


def by_definition(simplices, relation):
    """Rows of a relation, from the vertices of all simplices of each dimension."""
    rows, entries = (simplices[DIMENSION[letter]] for letter in relation)
    if relation == "VV":
        edges = simplices[1]
        return [sorted(v for e in edges if x <= e for v in e - x) for x in rows]
    if relation[0] == relation[1]:
        return [[j for j, y in enumerate(entries) if len(x & y) == len(x) - 1] for x in rows]
    return [[j for j, y in enumerate(entries) if x < y or y < x] for x in rows]


class Dump(gale.CommandTest):
    def dump(self, relation, *arguments):
        self.succeed("relations", *arguments, "--relation", relation, "--dump", "rows.txt")
        return (self.folder / "rows.txt").read_text()

    def rows(self, relation, *arguments):
        header, *lines = self.dump(relation, *arguments).splitlines()
        rows = [[int(word) for word in line.split(":")[1].split()] for line in lines]
        self.assertEqual([int(line.split(":")[0]) for line in lines], list(range(len(lines))))
        self.assertEqual(header, f"# {relation}: {len(rows)} rows, {sum(map(len, rows))} entries")
        return rows

    def simplices(self, *arguments):
        """Sets of vertices by dimension, in the order that the dumps have."""
        tetrahedra = self.rows("TV", *arguments)
        faces = lambda size: sorted({face for t in tetrahedra for face in itertools.combinations(t, size)})
        vertices = range(max(map(max, tetrahedra)) + 1)
        return [[{v} for v in vertices], [set(e) for e in faces(2)], [set(f) for f in faces(3)], [set(t) for t in tetrahedra]]

    def test_rows_are_those_of_the_definition(self):
        simplices = self.simplices("grid:3")
        self.assertEqual(len(simplices[3]), 48)
        for relation in RELATIONS:
            with self.subTest(relation=relation):
                self.assertEqual(self.rows(relation, "grid:3", "--capacity", 5), by_definition(simplices, relation))

    def test_rows_are_the_same_whatever_the_structure_and_the_segments(self):
        for turn, relation in enumerate(RELATIONS):
            ways = [(gale.STRUCTURES[0], 1), (gale.STRUCTURES[0], 1000)]
            ways += [(structure, (1, 30, 1000)[(turn + i) % 3]) for i, structure in enumerate(gale.STRUCTURES)]
            dumps = {self.dump(relation, "grid:6", "--structure", structure, "--capacity", capacity) for structure, capacity in ways}
            self.assertEqual(len(dumps), 1, relation)


class Verification(gale.CommandTest):
    def test_finds_no_difference(self):
        for relation in RELATIONS:
            with self.subTest(relation=relation):
                report = self.report("relations", "grid:12", "--relation", relation, "--verify", "--capacity", 40)
                self.assertEqual(report["result"]["differences"], 0)

    def test_finds_no_difference_with_random_segments(self):
        for relation in RELATIONS:
            with self.subTest(relation=relation):
                report = self.report("relations", "grid:8", "--relation", relation, "--verify", "--segments", "random:13")
                self.assertEqual((report["result"]["differences"], report["mesh"]["segments"]), (0, 13))

    @gale.needs_vtk
    @unittest.skipUnless(BRAIN.exists(), f"there is no {BRAIN}")
    def test_finds_no_difference_in_a_brain(self):
        for relation in ("EF", "TT"):
            report = self.report("relations", BRAIN, "--above", "60", "--relation", relation, "--verify")
            self.assertEqual(report["result"]["differences"], 0)
            self.assertGreater(report["mesh"]["edges"], 0)


    @unittest.skipUnless("explicit" in gale.STRUCTURES, "this gale has no Kokkos-Kernels")
    def test_does_not_compare_a_structure_with_itself(self):
        self.assertIn("0 from brute force", self.succeed("relations", "grid:6", "--relation", "EE", "--verify", "--structure", "explicit"))
        self.assertIn("0 from the explicit structure", self.succeed("relations", "grid:6", "--relation", "EE", "--verify"))


class Report(gale.CommandTest):
    def test_has_the_sizes(self):
        report = self.report("relations", "grid:4", "--relation", "FT")
        self.assertEqual(report["result"], {"relation": "FT", "rows": 378, "entries": 648, "longest_row": 2})
        self.assertEqual((report["mesh"]["edges"], report["mesh"]["triangles"]), (279, 378))

    def test_says_nothing_of_what_it_did_not_need(self):
        mesh = self.report("relations", "grid:4", "--relation", "VE")["mesh"]
        self.assertEqual((mesh["edges"], mesh["triangles"]), (279, None))


class Usage(gale.CommandTest):
    def test_refuses_what_is_no_relation(self):
        self.refuse(2, "relations", "grid:4", naming="--relation")
        self.refuse(2, "relations", "grid:4", "--relation", "VX", naming="VX")
        self.refuse(2, "relations", "grid:4", "--relation", "link", naming="link")

    def test_refuses_segments_that_are_no_number(self):
        for segments in ("random:", "random:0", "random:-1", "random:2x", "random:99999999999999999999"):
            self.refuse(2, "relations", "grid:4", "--relation", "VE", "--segments", segments, naming=segments)

    def test_refuses_one_name_for_two_files(self):
        self.refuse(2, "relations", "grid:4", "--relation", "VE", "--dump", "rows", "--report", "./rows", naming="rows")
        self.assertEqual(self.names(), [])

    def test_refuses_a_file_that_it_cannot_write(self):
        self.refuse(1, "relations", "grid:4", "--relation", "VE", "--dump", "nowhere/rows.txt", naming="nowhere")
        self.assertEqual(self.names(), [])


if __name__ == "__main__":
    unittest.main()
