"""Exodus and VTKHDF files: the same results as from a .vtu, and one line for bad files, in little memory and time."""
import os
import random
import resource
import shutil
import subprocess
import unittest
from pathlib import Path

import exodus_files  # of the fuzzer
import gale  # of the command's tests


class Foreign(gale.CommandTest):
    def convert(self, source, to, *times):
        subprocess.run([os.environ["GALE_WRITE_FOREIGN"], source, to, *times], cwd=self.folder, check=True, timeout=60)
        return to

    def mesh(self, size, to):
        self.succeed("generate", f"grid:{size}", "-o", "mesh.vtu")
        return self.convert("mesh.vtu", to)

    def test_results_are_those_of_the_same_mesh_in_a_vtu(self):
        self.succeed("generate", "grid:12", "-o", "mesh.vtu")
        self.succeed("critical-points", "mesh.vtu", "-o", "expected.vtp")
        expected = gale.read_vtp(self.folder / "expected.vtp")
        for name in ("mesh.e", "mesh.ex2", "mesh.exo", "mesh.vtkhdf"):
            with self.subTest(name):
                self.succeed("critical-points", self.convert("mesh.vtu", name), "-o", "found.vtp")
                self.assertEqual(gale.read_vtp(self.folder / "found.vtp"), expected)

    def test_what_is_written_is_read(self):
        """By the HDF5 library: compressed chunks and, of the small ones, arrays in one piece."""
        for size in ("3", "48"):
            self.succeed("generate", f"grid:{size}", "-o", "mesh.vtu")
            self.succeed("generate", f"grid:{size}", "-o", "mesh.vtkhdf")
            for name in ("mesh.vtu", "mesh.vtkhdf"):
                self.succeed("critical-points", name, "-o", f"{name}.vtp")
            self.assertEqual(gale.read_vtp(self.folder / "mesh.vtkhdf.vtp"), gale.read_vtp(self.folder / "mesh.vtu.vtp"))
        self.succeed("morse-smale", "grid:12", "-o", "p")
        self.succeed("morse-smale", "grid:12", "-o", "p", "--format", "vtkhdf")
        self.assertTrue(all((self.folder / f"p_{name}.vtkhdf").exists() for name in ("critical_points", "separatrices1", "segmentation")))
        found, expected = (self.report("critical-points", f"p_segmentation.{kind}", "--array", "MorseSmaleManifold")["result"]
                           for kind in ("vtkhdf", "vtu"))
        self.assertEqual(found, expected)

    def datasets(self, name):
        """Type, rows and values of each dataset, as HDF5's library reads them; rows of several values are tuples."""
        run = subprocess.run([os.environ["GALE_PRINT_HDF5"], name], cwd=self.folder, check=True, capture_output=True, text=True, timeout=60)
        sets = {}
        for line in run.stdout.splitlines():
            words = line.split()
            at = next(k for k, word in enumerate(words) if word in gale.XmlFile.CODES)
            parse = float.fromhex if words[at].startswith("Float") else int
            values, shape = list(map(parse, words[at + 2:])), list(map(int, words[at + 1].split("x")))
            if len(shape) == 2:
                values = [tuple(values[i:i + shape[1]]) for i in range(0, len(values), shape[1])]
            self.assertEqual(len(values), shape[0], line[:200])
            sets[" ".join(words[:at])] = (words[at], values)
        return sets

    def expect_written_alike(self, xml, hdf, kinds):
        """That a .vtkhdf has what a .vtu or .vtp has: `kinds` of cells, their names in both."""
        file, sets = gale.XmlFile(self.folder / xml), self.datasets(hdf)
        expected = {"/Points": (file.piece.find("Points/DataArray").get("type"), file.points)}
        for kind in ("PointData", "CellData"):
            for name, values in file.arrays(kind).items():
                expected[f"/{kind}/{name}"] = (file.types(kind)[name], values)
        for kind, group in kinds.items():
            types, arrays = file.types(kind), file.arrays(kind)
            expected[f"{group}/Connectivity"] = (types["connectivity"], arrays["connectivity"])
            expected[f"{group}/Offsets"] = (types["offsets"], [0, *arrays["offsets"]])
            if "types" in arrays:
                expected[f"{group}/Types"] = (types["types"], arrays["types"])
            expected[f"{group}/NumberOfCells"] = ("Int64", [len(arrays["offsets"])])
            expected[f"{group}/NumberOfConnectivityIds"] = ("Int64", [len(arrays["connectivity"])])
        expected["/NumberOfPoints"] = ("Int64", [len(file.points)])
        self.assertEqual(set(sets), set(expected))
        for path, values in expected.items():
            self.assertEqual(sets[path], values, path)

    def test_surfaces_and_lines_are_those_of_the_xml(self):
        surface = {"Verts": "/Vertices", "Lines": "/Lines", "Strips": "/Strips", "Polys": "/Polygons"}
        for size in ("4", "24"):  # the larger in compressed chunks
            self.succeed("morse-smale", f"grid:{size}", "--separatrices2", "-o", "p")
            self.succeed("morse-smale", f"grid:{size}", "--separatrices2", "-o", "p", "--format", "vtkhdf")
            for name in ("critical_points", "separatrices1", "separatrices2"):
                with self.subTest(name=name, size=size):
                    self.expect_written_alike(f"p_{name}.vtp", f"p_{name}.vtkhdf", surface)
            self.expect_written_alike("p_segmentation.vtu", "p_segmentation.vtkhdf", {"Cells": ""})
        self.succeed("persistence-diagram", "grid:24", "-o", "diagram.vtu")
        self.succeed("persistence-diagram", "grid:24", "-o", "diagram.vtkhdf")
        self.expect_written_alike("diagram.vtu", "diagram.vtkhdf", {"Cells": ""})

    def expect_steps(self, name, files, times):
        """Has an input of several times be those files, one after the other."""
        steps = self.report("critical-points", name, "-o", "all.vtp")["steps"]
        self.assertEqual([step["time"] for step in steps], times)
        for k, file in enumerate(files):
            self.succeed("critical-points", file, "-o", "alone.vtp")
            self.assertEqual(gale.read_vtp(self.folder / f"all_{k:04}.vtp"), gale.read_vtp(self.folder / "alone.vtp"))
        last = self.report("critical-points", name, "--times", "last", "-o", "last.vtp")
        self.assertEqual([step["time"] for step in last["steps"]], times[-1:])
        self.assertEqual((self.folder / "last_0000.vtp").read_bytes(), (self.folder / f"all_{len(files) - 1:04}.vtp").read_bytes())

    def test_several_times_are_steps(self):
        self.mesh(6, "mesh.e")
        self.convert("mesh.vtu", "often.e", "3")
        self.convert("mesh.vtu", "often.vtkhdf", "3")
        for k in range(3):
            self.convert("mesh.vtu", f"alone{k}.vtkhdf", "3", str(k))
            self.convert("mesh.vtu", f"alone{k}.e", "3", str(k))
        self.expect_steps("often.e", [f"alone{k}.e" for k in range(3)], [0, 1, 2])
        self.expect_steps("often.vtkhdf", [f"alone{k}.vtkhdf" for k in range(3)], [0, 1, 2])
        self.convert("5", "often_image.vtkhdf", "3")
        for k in range(3):
            self.convert("5", f"image{k}.vtkhdf", "3", str(k))
        self.expect_steps("often_image.vtkhdf", [f"image{k}.vtkhdf" for k in range(3)], [0, 1, 2])
        for name in ("often.e", "often.vtkhdf", "often_image.vtkhdf"):
            self.assertEqual(self.report("info", name)["notices"], ["left out all but the first of 3 time steps"])
        self.assertIsNone(self.report("critical-points", "mesh.e", "-o", "mesh.vtp")["steps"])

    def test_image_is_split(self):
        self.convert("5", "image.vtkhdf")
        self.assertIn("ramp", self.succeed("info", "image.vtkhdf"))
        self.assertEqual(self.counts("image.vtkhdf"), [1, 0, 0, 1, 0])
        report = self.report("info", "image.vtkhdf", "--above", "8")
        # The points of the 125 where x + 2y + 3z is above 8.
        above = sum(x + 2 * y + 3 * z > 8 for x in range(5) for y in range(5) for z in range(5))
        self.assertLessEqual(report["mesh"]["vertices"], above)
        self.assertGreater(report["mesh"]["vertices"], 60)

    def test_files_of_another_kind_are_refused(self):
        self.write("text.e", "no mesh")
        self.refuse(1, "info", "text.e", naming="it is no Exodus II file")
        self.write("text.hdf", "no mesh")
        self.refuse(1, "info", "text.hdf", naming="it is no VTKHDF file")
        self.write("empty.e", "")
        self.refuse(1, "info", "empty.e", naming="empty.e")
        self.refuse(1, "info", "absent.vtkhdf", naming="absent.vtkhdf")

    def test_damaged_files_end_in_one_line_or_a_mesh(self):
        random.seed(17)
        outcomes = set()
        for name in ("mesh.e", "mesh.vtkhdf"):
            content = (self.folder / self.mesh(5, name)).read_bytes()
            for turn in range(30):
                bad = bytearray(content)
                if turn % 3 == 0:
                    del bad[random.randrange(len(bad)):]
                for _ in range(turn):
                    if bad:
                        bad[random.randrange(len(bad))] = random.choice((0, 255, random.randrange(256)))
                file = self.write(f"bad{Path(name).suffix}", bytes(bad))
                run = self.gale("info", file)
                outcomes.add(run.returncode)
                if run.returncode == 0:
                    self.assertEqual(run.stderr, "")
                else:
                    self.assertEqual(run.returncode, 1, run.stderr)
                    self.assertRegex(run.stderr, r"\Agale: [^\n]+\n\Z")  # also about a coordinate that isn't finite
        self.assertEqual(outcomes, {0, 1})

    def test_program_is_looked_for_beside_the_command(self):
        alone = self.copy_of_command()
        self.mesh(4, "mesh.vtkhdf")
        run = subprocess.run([alone, "info", "mesh.vtkhdf"], cwd=self.folder, capture_output=True, text=True, timeout=60)
        self.assertRegex(run.stderr, r"\Agale: cannot read 'mesh.vtkhdf': such files are read by gale-hdf5-reader, which isn't [^\n]+\n\Z")
        shutil.copy(os.environ["GALE_HDF5_READER"], self.folder)
        subprocess.run([alone, "info", "mesh.vtkhdf"], cwd=self.folder, check=True, stdout=subprocess.DEVNULL, timeout=60)

    def strange(self):
        (self.folder / "strange").mkdir()
        self.convert("strange", "strange")
        return self.folder / "strange"

    def test_values_of_other_files_are_refused_by_name(self):
        folder = self.strange()
        (folder / "secret.raw").write_bytes(bytes(256))
        self.assertIn("ramp", self.succeed("info", "strange/secret.vtkhdf"))
        ramp = "its 'VTKHDF/PointData/ramp' "
        for name, naming in {
                "outside": ramp + "has its values in the file 'secret.raw'",
                "virtual": ramp + "consists of parts of other datasets, in the file 'secret.vtkhdf'",
                "link_to_array": ramp + "is a link to '/VTKHDF/PointData/ramp' in the file 'secret.vtkhdf'",
                "link_to_group": "its 'VTKHDF/PointData' is a link to '/VTKHDF/PointData' in the file 'secret.vtkhdf'",
                "link_to_link": ramp + "is a soft link to '/elsewhere'",
                "link_to_itself": ramp + "is a soft link to 'ramp'",
                "link_of_a_user": ramp + "is a link of an unknown kind",
                "plugin": ramp + "is packed by HDF5's filter 300"}.items():
            for more in ((), ("--outside-files",)):
                with self.subTest(name, more=more):
                    self.refuse(1, "info", f"strange/{name}.vtkhdf", *more, naming=naming)

    def test_values_that_a_file_does_not_have_are_refused(self):
        self.strange()
        for name, naming in {"never_written": "has no values", "half_written": "has no values from (2, 0, 0) on",
                             "chunk_of_few_bytes": "stands for 256 bytes, and there are 8", "unpacked_chunk_of_few_bytes": "has another size",
                             "packed_chunk_of_other_bytes": "isn't what deflate makes"}.items():
            with self.subTest(name):
                self.refuse(1, "info", f"strange/{name}.vtkhdf", naming=naming)
        whole = exodus_files.exodus()
        self.write("whole.e", whole.content())
        self.assertIn("other", self.succeed("info", "whole.e"))
        for absent, naming in {"vals_nod_var2": "'other' is declared and has no values", "coordy": "it has no 'coordy'",
                               "connect2": "it has no 'connect2'", "name_nod_var": "it has no 'name_nod_var'"}.items():
            with self.subTest(absent):
                file = exodus_files.exodus()
                file.variables = [variable for variable in file.variables if variable.name != absent]
                self.write("part.e", file.content())
                self.refuse(1, "info", "part.e", naming=naming)
        self.write("cut.e", whole.content()[:-120])
        self.refuse(1, "info", "cut.e", naming="ends at byte")
        self.write("early.e", exodus_files.exodus(times=0).content())
        self.assertIn("it has no time yet", self.report("info", "early.e")["notices"][0])

    def test_vectors_have_the_names_that_vtk_gives_them(self):
        names = ("a", "v_x", "v_y", "v_z", "UX", "UY", "sxx", "syy", "szz", "sxy", "sxz", "syz", "x", "y")
        self.write("vectors.e", exodus_files.exodus(names=names).content())
        arrays = {array["name"]: array["components"] for array in self.report("info", "vectors.e")["result"]["arrays"]}
        self.assertEqual(arrays, {"a": 1, "v_": 3, "U": 2, "s": 6, "x": 1, "y": 1})

    def test_small_files_take_little_memory_and_time(self):
        self.strange()
        for name, naming in {"parts": "it has no", "points": "its 'VTKHDF/Points'"}.items():
            with self.subTest(name):
                before = resource.getrusage(resource.RUSAGE_CHILDREN)
                self.refuse(1, "info", f"strange/{name}.vtkhdf", naming=naming)
                after = resource.getrusage(resource.RUSAGE_CHILDREN)
                self.assertLess(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, 5)  # 55, before
                self.assertLess(after.ru_maxrss, 160 << 10)  # KiB of the largest so far; 2.8 GiB, before

    def test_written_arrays_of_more_than_1024_chunks_are_read(self):
        """The last test: others ask how much memory all before it took."""
        self.succeed("generate", "plane:3400", "-o", "large.vtkhdf")  # 277 MB of connectivity, 256 KiB a chunk
        self.assertEqual(self.report("critical-points", "large.vtkhdf")["result"], self.report("critical-points", "plane:3400")["result"])


if __name__ == "__main__":
    unittest.main()
