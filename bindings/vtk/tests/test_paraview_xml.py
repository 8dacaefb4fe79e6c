"""What ParaView's window says of the filters (bindings/paraview/plugin/filters.xml), against the classes."""
import unittest
import xml.etree.ElementTree
from pathlib import Path

from galevtk import vtkFiltersGale
from vtkmodules.vtkCommonCore import VTK_IMAGE_STENCIL_DATA
from vtkmodules.vtkCommonDataModel import vtkDataObjectTypes

PLUGIN = Path(__file__).parents[2] / "paraview" / "plugin"
HEADERS = (Path(__file__).parents[1] / "filters").glob("vtkGale*.h")
CLASSES = sorted({header.stem for header in HEADERS} - {"vtkGaleAlgorithm"})
OF_VTK = ("InputArrayToProcess", "InputConnection")


class Filters(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        root = xml.etree.ElementTree.parse(PLUGIN / "filters.xml").getroot()
        proxies = {proxy.get("class"): proxy for proxy in root.iter("SourceProxy")}
        cls.base = proxies.pop("vtkGaleAlgorithm")
        cls.proxies = proxies

    def properties(self, name):
        """By the command without its Set."""
        own = [element for proxy in (self.base, self.proxies[name]) for element in proxy if element.tag.endswith("Property")]
        return {element.get("command")[3:]: element for element in own}

    def test_all_filters_are_there(self):
        self.assertEqual(set(self.proxies), set(CLASSES))
        for proxy in self.proxies.values():
            self.assertEqual((proxy.get("base_proxygroup"), proxy.get("base_proxyname")), ("internal_filters", self.base.get("name")))

    def test_each_setting_of_a_class_is_a_property_with_its_default(self):
        for name in CLASSES:
            made = getattr(vtkFiltersGale, name)()
            base = {key for key in dir(vtkFiltersGale.vtkGaleAlgorithm.__bases__[0])}
            settings = {key[3:] for key in dir(made) if key.startswith("Set") and key not in base and hasattr(made, f"Get{key[3:]}")}
            settings -= {"InputData"}
            properties = self.properties(name)
            self.assertEqual(set(properties) - set(OF_VTK), settings)
            for key in settings:
                self.assertEqual(float(properties[key].get("default_values")), float(getattr(made, f"Get{key}")()), f"{name}: {key}")
                self.assertEqual(properties[key].get("name"), key)

    def test_ranges_are_the_classes(self):
        compared = 0
        for name in CLASSES:
            made = getattr(vtkFiltersGale, name)()
            for key, element in self.properties(name).items():
                for domain in element.findall("IntRangeDomain"):
                    ends = [getattr(made, f"Get{key}{end}Value")() for end in ("Min", "Max")]
                    self.assertEqual([int(domain.get("min")), int(domain.get("max", 2**31 - 1))], ends, f"{name}: {key}")
                    compared += 1
        self.assertGreaterEqual(compared, 2 * len(CLASSES))

    def test_inputs_are_what_the_filters_take(self):
        types = [element.get("value") for element in self.base.iter("DataType")]
        taken = set()
        for number in range(VTK_IMAGE_STENCIL_DATA + 1):
            made = vtkDataObjectTypes.NewDataObject(number)
            if made is None or not made.IsA("vtkDataSet"):
                continue
            said = []
            segments = vtkFiltersGale.vtkGaleSegmentation()
            segments.AddObserver("ErrorEvent", lambda *_: said.append(1))
            segments.SetInputData(made)
            segments.Update()
            self.assertEqual(not said, any(made.IsA(type_) for type_ in types), made.GetClassName())
            taken.update([] if said else [made.GetClassName()])
        self.assertLess({"vtkUnstructuredGrid", "vtkStructuredGrid", "vtkPolyData", "vtkImageData", "vtkRectilinearGrid"}, taken)

    def test_ports_have_names(self):
        for name in CLASSES:
            ports = self.proxies[name].findall("OutputPort")
            self.assertEqual([port.get("index") for port in ports], [str(k) for k in range(getattr(vtkFiltersGale, name)().GetNumberOfOutputPorts())])
            self.assertTrue(all(port.get("name") for port in ports))

    def test_menu_icons_and_help(self):
        resources = xml.etree.ElementTree.parse(PLUGIN / "icons.qrc").getroot().find("qresource")
        icons = {f":{resources.get('prefix')}/{file.get('alias')}": PLUGIN / file.text for file in resources}
        for name in CLASSES:
            menu = self.proxies[name].find("Hints/ShowInMenu")
            self.assertEqual(menu.get("category"), "GALE")
            self.assertTrue(icons[menu.get("icon")].read_bytes().startswith(b"\x89PNG"))
            self.assertGreater(len(self.proxies[name].find("Documentation").text), 40)
            for key, element in self.properties(name).items():
                self.assertGreater(len(element.find("Documentation").text), 20, f"{name}: {key}")


if __name__ == "__main__":
    unittest.main()
