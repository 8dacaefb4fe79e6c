#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include <gale/io/read.hpp>

#include "io/io_fixtures.hpp"

/// Files that were seen to crash, to hang, to fill the memory or to give wrong results where VTK read them; and valid
/// ones that it refused.
namespace gale::io {
namespace {

using test::error_of;
using test::values_of;

class HostileFiles : public test::VtkTest {
 protected:
  void refuse(const std::string& name, const std::string& content, const std::string& naming) {
    const std::string path = folder.put(name, content);
    const std::string message = error_of([&] { read(path); });
    EXPECT_EQ(message.find("cannot read '" + path + "': "), 0u) << message;
    EXPECT_NE(message.find(naming), std::string::npos) << message;
  }
};

std::string legacy(const std::string& rest, const std::string& version = "5.1") {
  return "# vtk DataFile Version " + version + "\nby hand\nASCII\nDATASET UNSTRUCTURED_GRID\n" + rest;
}

const std::string four_points = "POINTS 4 float\n0 0 0 1 0 0 0 1 0 0 0 1\n";

std::string cells_51(const std::string& offsets, const std::string& connectivity) {
  const auto words = [](const std::string& text) {
    std::istringstream stream(text);
    std::string word;
    int count = 0;
    while (stream >> word) ++count;
    return std::to_string(count);
  };
  return four_points + "CELLS " + words(offsets) + " " + words(connectivity) + "\nOFFSETS vtktypeint64\n" + offsets +
         "\nCONNECTIVITY vtktypeint64\n" + connectivity + "\nCELL_TYPES 1\n10\n";
}

TEST_F(HostileFiles, LegacyCellsThatLieOutside) {
  EXPECT_EQ(read(folder.put("good.vtk", legacy(cells_51("0 4", "0 1 2 3")))).tetrahedra.extent(0), 1u);
  refuse("a.vtk", legacy(cells_51("0 5", "0 1 2 3")), "ends at 5");
  refuse("b.vtk", legacy(cells_51("0 400000000000", "0 1 2 3")), "ends at 400000000000");
  refuse("c.vtk", legacy(cells_51("0 -4", "0 1 2 3")), "ends at -4");
  refuse("d.vtk", legacy(cells_51("2 4", "0 1 2 3")), "first offset");
  refuse("e.vtk", legacy(cells_51("0 3", "0 1 2 3")), "of 3 points");
  refuse("f.vtk", legacy(cells_51("0 4", "0 1 2 4294967299")), "names point 4294967299 of 4");
  refuse("g.vtk", legacy(cells_51("0 4", "0 1 2 -1")), "names point -1 of 4");
}

TEST_F(HostileFiles, LegacyCountsThatNoFileHas) {
  refuse("a.vtk", legacy("POINTS -1 float\n"), "-1");
  refuse("b.vtk", legacy("POINTS 9000000000000000000 float\n0 0 0\n"), "points");
  refuse("c.vtk", legacy(four_points + "CELLS 1 5\n100000000 0 1 2 3\nCELL_TYPES 1\n10\n", "3.0"), "100000000 points");
  refuse("d.vtk", legacy(four_points + "CELLS 1 5\n-1 0 1 2 3\nCELL_TYPES 1\n10\n", "3.0"), "-1 points");
  refuse("e.vtk", legacy(four_points + "CELLS 400000000 2000000000\n4 0 1 2 3\n", "3.0"), "of 2000000000 values");
  refuse("f.vtk", legacy(four_points + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n200\n", "3.0"), "unknown type 200");
  refuse("g.vtk", legacy(four_points + "CELLS -7 -9\n", "3.0"), "-7");
}

TEST_F(HostileFiles, LegacyGridsThatClaimMorePointsThanTheyHave) {
  const auto grid = [](const std::string& rest) {
    return "# vtk DataFile Version 3.0\nby hand\nASCII\nDATASET " + rest;
  };
  for (const std::string rest : {"STRUCTURED_GRID\nDIMENSIONS 2 2 4294967296\nPOINTS 1 float\n0 0 0\n",
                                 "RECTILINEAR_GRID\nDIMENSIONS 1000 1000 1000\nX_COORDINATES 2 float\n0 1\n"}) {
    const std::string path = folder.put("a.vtk", grid(rest));
    EXPECT_NE(error_of([&] { read(path); }).find("it has "), std::string::npos);
  }
}

TEST_F(HostileFiles, LegacyImagesWhoseDimensionsChange) {
  const std::string start = "# vtk DataFile Version 3.0\nby hand\nASCII\nDATASET STRUCTURED_POINTS\nDIMENSIONS 2 2 2\n";
  const std::string values = "POINT_DATA 8\nSCALARS h float 1\nLOOKUP_TABLE default\n1 2 3 4 5 6 7 8\n";
  EXPECT_EQ(read(folder.put("good.vtk", start + values)).tetrahedra.extent(0), 6u);
  refuse("a.vtk", start + "POINTS 8 float\n" + values, "points");
  refuse("b.vtk", start + values + "DIMENSIONS 20 20 20\n", "8 tuples for 8000 points");
  const std::string mesh = four_points + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\n";
  const std::string heights = "POINT_DATA 4\nSCALARS h float 1\nLOOKUP_TABLE default\n1 2 3 4\n";
  refuse("c.vtk", legacy(mesh + heights + "POINTS 5 float\n0 0 0 1 0 0 0 1 0 0 0 1 1 1 1\n", "3.0"), "4 tuples for 5");
}

TEST_F(HostileFiles, LegacyNumbersThatAreNone) {
  const std::string mesh = four_points + "CELLS 1 5\n4 0 1 2 3\nCELL_TYPES 1\n10\nPOINT_DATA 4\nSCALARS h float 1\n";
  const Dataset valid = read(folder.put("a.vtk", legacy(mesh + "LOOKUP_TABLE default\n1 -inf nan inf\n", "3.0")));
  const auto& heights = values_of<float>(valid.arrays[0]);
  EXPECT_EQ(heights[1], -std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isnan(heights[2]));
  refuse("b.vtk", legacy(mesh + "LOOKUP_TABLE default\n1 2 x 4\n", "3.0"), "'x'");
  refuse("c.vtk", legacy(mesh + "LOOKUP_TABLE default\n1 2 3\n", "3.0"), "3 of 4 values");
}

std::string hostile_vti(const std::string& attributes, const std::string& pieces) {
  return R"(<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian" )" + attributes +
         R"(><ImageData WholeExtent="0 1 0 1 0 1" Origin="0 0 0" Spacing="1 1 1">)" + pieces + "</ImageData></VTKFile>";
}

std::string piece(const std::string& extent, const std::string& array_attributes, const std::string& values) {
  return "<Piece Extent=\"" + extent + R"("><PointData Scalars="h"><DataArray type="UInt8" Name="h" )" +
         array_attributes + ">" + values + "</DataArray></PointData></Piece>";
}

const std::string as_text = R"(format="ascii")";

TEST_F(HostileFiles, ImagesWhosePiecesLeaveGaps) {
  const std::string low = piece("0 1 0 1 0 0", as_text, "1 2 3 4"), high = piece("0 1 0 1 1 1", as_text, "5 6 7 8");
  const Dataset whole = read(folder.put("whole.vti", hostile_vti("", low + high)));
  EXPECT_EQ(values_of<std::uint8_t>(whole.arrays[0]), (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8}));
  refuse("a.vti", hostile_vti("", low), "cover");
  refuse("b.vti", hostile_vti("", low + low), "cover");
  refuse("c.vti", hostile_vti("", piece("0 1 0 1 0 2", as_text, "1 2 3 4 5 6 7 8 9 10 11 12")), "WholeExtent");
  refuse("d.vti", hostile_vti("", piece("0 1 0 1 0 1", as_text, "1 2 3 4 5 6 7")), "7 of 8 values");
  refuse("e.vti", hostile_vti("", piece("0 1 0 1 0 1", R"(format="ascii" NumberOfComponents="2147483647")", "1 2 3")),
         "2147483647");
}

TEST_F(HostileFiles, ArraysThatStopEarly) {
  // Base64 of the length 8 in four bytes, and of 1 to 8.
  refuse("a.vti", hostile_vti("", piece("0 1 0 1 0 1", R"(format="binary")", "CAAAAAECAwQFBg==")), "6 of 8 values");
  EXPECT_EQ(
      read(folder.put("good.vti", hostile_vti("", piece("0 1 0 1 0 1", R"(format="binary")", "CAAAAAECAwQFBgcI"))))
          .arrays.size(),
      1u);
  refuse("b.vti", hostile_vti("", piece("0 1 0 1 0 1", R"(format="binary")", "BwAAAAECAwQFBgcI")), "7 bytes");
  refuse("c.vti", hostile_vti("", piece("0 1 0 1 0 1", R"(format="appended" offset="0")", "")), "appended");
}

TEST_F(HostileFiles, CompressedArraysOfNoBytes) {
  // No blocks, where 8 values are to be: the header's three numbers are 0.
  const std::string path =
      folder.put("a.vti", hostile_vti("compressor=\"vtkZLibDataCompressor\"",
                                      piece("0 1 0 1 0 1", R"(format="binary")", "AAAAAAAAAAAAAAAA")));
  EXPECT_NE(error_of([&] { read(path); }).find("0 bytes"), std::string::npos);
}

TEST_F(HostileFiles, GridsWhoseCountsAreNone) {
  const auto vtu = [](const std::string& points, const std::string& cells) {
    return R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian"><UnstructuredGrid>
<Piece NumberOfPoints=")" +
           points + "\" NumberOfCells=\"" + cells + R"("><Points><DataArray type="Float32"
NumberOfComponents="3" format="ascii">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>
<DataArray type="Int64" Name="connectivity" format="ascii">0 1 2 3</DataArray>
<DataArray type="Int64" Name="offsets" format="ascii">4</DataArray>
<DataArray type="UInt8" Name="types" format="ascii">10</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>)";
  };
  EXPECT_EQ(read(folder.put("good.vtu", vtu("4", "1"))).tetrahedra.extent(0), 1u);
  refuse("a.vtu", vtu("4", "-1"), "'-1'");
  refuse("b.vtu", vtu("-4", "1"), "'-4'");
  refuse("c.vtu", vtu("18446744073709551615", "1"), "18446744073709551615");
  refuse("d.vtu", vtu("4", "400000000"), "of 400000000 values");
  refuse("e.vtu", "<!DOCTYPE x [<!ENTITY a \"b\">]>" + vtu("4", "1"), "document type");
}

const std::string mha_header = "NDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\n";

TEST_F(HostileFiles, MetaImageHeaders) {
  EXPECT_EQ(read(folder.put("good.mha", mha_header + "ElementDataFile = LOCAL\nabcdefgh")).tetrahedra.extent(0), 6u);
  refuse("a.mha", "NDims = -1\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = LOCAL\nabcdefgh", "-1");
  refuse("b.mha",
         "NDims = 3\nDimSize = 1000 1000 1000\nElementType = MET_UCHAR\nCompressedData = True\n"
         "ElementDataFile = LOCAL\nx\x9c\x03",
         "of 1000000000 values");
  refuse("c.mha", mha_header + "BinaryData = False\nElementDataFile = LOCAL\n1 2 3 4 5 6 7 eight\n", "eight");
  refuse("d.mha", mha_header + "BinaryData = False\nElementDataFile = LOCAL\n1 2 3 4 5 6 7\n", "7 of 8 values");
  for (const std::string name : {"%s%s%n", "%1000000000d", "%", "%d %d"}) {
    refuse("format.mhd", mha_header + "ElementDataFile = " + name + "\n", "cannot read");
  }
}

TEST_F(HostileFiles, MetaImageDataOutsideOfItsFolder) {
  std::filesystem::create_directory(folder / "inner");
  folder.put("outside.raw", "abcdefgh");
  const std::string path = folder.put("inner/a.mhd", mha_header + "ElementDataFile = ../outside.raw\n");
  EXPECT_NE(error_of([&] { read(path); }).find("outside of its folder"), std::string::npos);
  ReadOptions trusting;
  trusting.outside_files = true;
  EXPECT_EQ(read(path, trusting).tetrahedra.extent(0), 6u);
  std::filesystem::create_symlink(folder / "outside.raw", folder / "inner/link.raw");
  const std::string by_link = folder.put("inner/b.mhd", mha_header + "ElementDataFile = link.raw\n");
  EXPECT_NE(error_of([&] { read(by_link); }).find("outside of its folder"), std::string::npos);
  refuse("inner/c.mhd", mha_header + "ElementDataFile = /etc/passwd\n", "outside of its folder");
}

TEST_F(HostileFiles, MetaImageSlicesInFilesOfTheirOwn) {
  folder.put("slice1.raw", "abcd");
  folder.put("slice2.raw", "efgh");
  const std::vector<std::uint8_t> expected = {'a', 'b', 'c', 'd', 'e', 'f', 'g', 'h'};
  for (const std::string files : {"slice%d.raw 1 2 1", "LIST\nslice1.raw\nslice2.raw"}) {
    const Dataset mesh = read(folder.put("a.mhd", mha_header + "ElementDataFile = " + files + "\n"));
    EXPECT_EQ(values_of<std::uint8_t>(mesh.arrays[0]), expected);
  }
  refuse("b.mhd", mha_header + "ElementDataFile = slice%d.raw 1 3 1\n", "at most 2");
}

const std::string nrrd_header = "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\n";

TEST_F(HostileFiles, Nrrd) {
  const std::vector<std::uint8_t> expected = {1, 2, 3, 4, 5, 6, 7, 8};
  const Dataset text = read(folder.put("text.nrrd", nrrd_header + "encoding: ascii\n\n1 2 3 4 5 6 7 8\n"));
  EXPECT_EQ(values_of<std::uint8_t>(text.arrays[0]), expected);
  const Dataset axes =
      read(folder.put("axes.nrrd", nrrd_header + "kinds: domain domain domain\nencoding: raw\n\nabcdefgh"));
  EXPECT_EQ(axes.arrays[0].components, 1);
  EXPECT_EQ(axes.tetrahedra.extent(0), 6u);
  refuse("a.nrrd", "NRRD0004", "dimension");
  refuse("b.nrrd", nrrd_header + "encoding: raw\n", "of 8 values");
  refuse("c.nrrd", nrrd_header + "encoding: ascii\n\n1 2 3\n", "of 8 values");
  refuse("d.nrrd", "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 1000 1000 1000\nencoding: ascii\n\n1 2 3\n", "values");
  refuse("e.nrrd", nrrd_header + "encoding: raw\ndata file: /etc/passwd\n", "outside of its folder");
}

TEST_F(HostileFiles, NrrdVoxelsStandWhereTheHeaderSays) {
  const Dataset mesh =
      read(folder.put("a.nrrd", nrrd_header + "space: left-posterior-superior\nspace origin: (1,2,3)\n"
                                              "space directions: (0,2,0) (1,0,0) (0,0,1)\nencoding: raw\n\nabcdefgh"));
  const std::vector<double> points = test::points_of(mesh);
  EXPECT_EQ(std::vector<double>(points.begin(), points.begin() + 6), (std::vector<double>{1, 2, 3, 1, 4, 3}));
}

TEST_F(HostileFiles, NiftiHeaders) {
  std::string header(352, '\0');
  const auto put16 = [&](std::size_t at, std::int16_t value) { std::memcpy(&header[at], &value, 2); };
  const std::int32_t size = 348;
  std::memcpy(&header[0], &size, 4);
  for (int d = 0; d < 4; ++d) put16(40 + 2 * d, d == 0 ? 3 : 2);
  put16(70, 2);
  std::memcpy(&header[344], "n+1", 3);
  const float offset = 352;
  std::memcpy(&header[108], &offset, 4);
  EXPECT_EQ(read(folder.put("good.nii", header + "abcdefgh")).tetrahedra.extent(0), 6u);
  put16(42, 0);
  refuse("a.nii", header + "abcdefgh", "is 0");
  put16(42, 2);
  const float far = 3e9f;
  std::memcpy(&header[108], &far, 4);
  refuse("b.nii", header + "abcdefgh", "behind its header");
}

}  // namespace
}  // namespace gale::io
