"""What the tests of gale morse-smale share."""
import gale

KINDS = ["critical_points.vtp", "separatrices1.vtp", "separatrices2.vtp", "segmentation.vtu"]


class ComplexTest(gale.CommandTest):
    def result(self, *arguments):
        result = self.report("morse-smale", *arguments)["result"]
        kept = result.pop("kept_below", None)  # of a simplification
        self.assertEqual(kept is not None, "--persistence" in arguments)
        self.assertEqual(list(result), ["critical", "euler", "separatrices", "manifolds"])
        self.assertEqual(list(result["separatrices"]), ["descending", "ascending", "saddle_connectors"])
        self.assertEqual(list(result["manifolds"]), ["ascending", "descending", "morse_smale"])
        c0, c1, c2, c3 = result["critical"]
        self.assertEqual(result["euler"], c0 - c1 + c2 - c3)
        return result

    def files(self, *arguments):
        """What the command wrote, by kind."""
        self.succeed("morse-smale", *arguments, "-o", "out")
        return {kind: gale.XmlFile(self.folder / f"out_{kind}") for kind in KINDS if (self.folder / f"out_{kind}").exists()}
