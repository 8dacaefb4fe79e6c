"""What ParaView's window says of the filters (bindings/paraview/plugin/filters.xml), against the classes."""
import unittest
import xml.etree.ElementTree
from pathlib import Path

from galevtk import vtkFiltersGale

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
