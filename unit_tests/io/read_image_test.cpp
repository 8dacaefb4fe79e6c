#include <cstdint>
#include <cstring>

#include <gtest/gtest.h>

#include <gale/io/read.hpp>
#include <gale/io/synthetic.hpp>

#include "io/io_fixtures.hpp"

namespace gale::io {
namespace {

using test::error_of;
using test::names_of;
using test::points_of;
using test::values_of;

class ReadImage : public test::VtkTest {};

ReadOptions above(double threshold, const std::string& array = "") { return {threshold, false, array}; }

template <class T>
std::string bytes_of(const std::vector<T>& values) {
  return std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
}

/// A NIfTI file of 16-bit voxels; fields of the header as in nifti1.h.
struct Nifti {
  std::vector<std::int16_t> dim = {3, 3, 2, 2, 1, 1, 1, 1};
  std::vector<float> pixdim = {1, 1, 1, 1, 0, 0, 0, 0};
  float slope = 1, intercept = 0;
  std::int16_t qform = 0, sform = 0;
  std::vector<float> quaternion_and_offset = std::vector<float>(6);
  std::vector<float> srow = std::vector<float>(12);
  std::vector<std::int16_t> voxels = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12};

  std::string bytes() const {
    std::string header(352, '\0');
    const auto put = [&](std::size_t offset, const auto& values) {
      const std::string bytes = bytes_of(values);
      header.replace(offset, bytes.size(), bytes);
    };
    put(0, std::vector<std::int32_t>{348});
    put(40, dim);
    put(70, std::vector<std::int16_t>{4, 16});
    put(76, pixdim);
    put(108, std::vector<float>{352, slope, intercept});
    put(252, std::vector<std::int16_t>{qform, sform});
    put(256, quaternion_and_offset);
    put(280, srow);
    header.replace(344, 3, "n+1");
    return header + bytes_of(voxels);
  }
};

TEST_F(ReadImage, NiftiKeepsTypeAndOrder) {
  const Dataset mesh = read(folder.put("a.nii", Nifti().bytes()), above(0));
  EXPECT_EQ(mesh.tetrahedra.extent(0), 12u);
  ASSERT_EQ(names_of(mesh.arrays), std::vector<std::string>{"NIFTI"});
  EXPECT_EQ(values_of<std::int16_t>(mesh.arrays[0]), Nifti().voxels);
  EXPECT_TRUE(mesh.notices.empty());
}

TEST_F(ReadImage, NiftiIsCutAtTheThreshold) {
  const Dataset mesh = read(folder.put("a.nii", Nifti().bytes()), above(1));
  EXPECT_EQ(values_of<std::int16_t>(mesh.arrays[0]), (std::vector<std::int16_t>{2, 3, 5, 6, 8, 9, 11, 12}));
}

TEST_F(ReadImage, NiftiStandsWhereItsSformSays) {
  Nifti file;
  file.pixdim = {1, 2, 2, 2, 0, 0, 0, 0};
  file.sform = 1;
  file.srow = {2, 0, 0, -10, 0, 2, 0, -20, 0, 0, 2, -30};
  const std::vector<double> points = points_of(read(folder.put("a.nii", file.bytes())));
  EXPECT_EQ(std::vector<double>(points.begin(), points.begin() + 6),
            (std::vector<double>{-10, -20, -30, -8, -20, -30}));
}

TEST_F(ReadImage, NiftiKeepsItsOrderWhereItIsLeftHanded) {
  Nifti by_sform;  // a mirrored x
  by_sform.sform = 1;
  by_sform.srow = {-1, 0, 0, 5, 0, 1, 0, 0, 0, 0, 1, 0};
  Nifti by_qform;  // half a turn about y and mirrored slices: (x, y, z) = (5 - i, j, k)
  by_qform.qform = 1;
  by_qform.pixdim[0] = -1;
  by_qform.quaternion_and_offset = {0, 1, 0, 5, 0, 0};
  for (const Nifti& file : {by_sform, by_qform}) {
    const Dataset mesh = read(folder.put("a.nii", file.bytes()));
    EXPECT_EQ(values_of<std::int16_t>(mesh.arrays[0]), file.voxels);
    const std::vector<double> points = points_of(mesh);
    EXPECT_EQ(std::vector<double>(points.begin(), points.begin() + 6), (std::vector<double>{5, 0, 0, 4, 0, 0}));
    EXPECT_EQ(std::vector<double>(points.end() - 3, points.end()), (std::vector<double>{3, 1, 1}));
    EXPECT_EQ(test::tetrahedra_of(mesh), test::tetrahedra_of(read(folder.put("b.nii", Nifti().bytes()))));
  }
}

TEST_F(ReadImage, NiftiIsRescaled) {
  Nifti file;
  file.slope = 0.5;
  file.intercept = -1;
  const Dataset mesh = read(folder.put("a.nii", file.bytes()), above(-0.5));
  EXPECT_EQ(values_of<float>(mesh.arrays[0]), (std::vector<float>{0, .5, 1.5, 2, 3, 3.5, 4.5, 5}));
}

TEST_F(ReadImage, NiftiReadsTheFirstTimeStep) {
  Nifti file;
  file.dim = {4, 3, 2, 2, 2, 1, 1, 1};
  file.voxels.resize(24, -1);
  const Dataset mesh = read(folder.put("a.nii", file.bytes()));
  EXPECT_EQ(values_of<std::int16_t>(mesh.arrays[0]), Nifti().voxels);
  EXPECT_EQ(mesh.notices, std::vector<std::string>{"left out all but the first of 2 time steps"});
}

/// An ASCII `.vti` of 3 x 2 x 2 points, with the given arrays.
std::string vti(const std::string& point_data, const std::string& cell_data = "") {
  return R"(<VTKFile type="ImageData" version="1.0" byte_order="LittleEndian">
<ImageData WholeExtent="1 3 0 1 2 3" Origin="10 20 30" Spacing="0.5 1 2"><Piece Extent="1 3 0 1 2 3">
<PointData Scalars="heat">)" +
         point_data + "</PointData><CellData>" + cell_data + "</CellData></Piece></ImageData></VTKFile>";
}

const std::string heat = R"(<DataArray type="UInt8" Name="heat" format="ascii">9 2 3 4 5 6 7 8 9 10 11 12</DataArray>)";
const std::string flow = R"(<DataArray type="Float64" Name="flow" NumberOfComponents="2" format="ascii">
0 1 0 2 0 3 0 4 0 5 0 6 0 7 0 8 0 9 0 10 0 11 0 12</DataArray>)";

TEST_F(ReadImage, VtiBeginsAtItsExtent) {
  const Dataset mesh = read(folder.put("a.vti", vti(flow + heat)));
  EXPECT_EQ(names_of(mesh.arrays), (std::vector<std::string>{"heat", "flow"}));
  const std::vector<double> points = points_of(mesh);
  EXPECT_EQ(std::vector<double>(points.begin(), points.begin() + 6), (std::vector<double>{10.5, 20, 34, 11, 20, 34}));
}

TEST_F(ReadImage, TheArrayDecides) {
  const std::string path = folder.put("a.vti", vti(heat + flow));
  EXPECT_EQ(read(path, above(1.5)).tetrahedra.extent(0), 12u);
  const Dataset mesh = read(path, above(1.5, "flow_1"));
  EXPECT_EQ(mesh.tetrahedra.extent(0), 6u);
  EXPECT_EQ(names_of(mesh.arrays), (std::vector<std::string>{"flow_1", "heat", "flow"}));
  EXPECT_EQ(error_of([&] { read(path, above(1, "flow")); }),
            "cannot read '" + path + "': the array 'flow' has 2 components: choose one of 'flow_0' to 'flow_1'");
  EXPECT_EQ(error_of([&] { read(path, above(1, "cold")); }),
            "cannot read '" + path + "': the image has no array 'cold', only 'heat', 'flow'");
}

TEST_F(ReadImage, RefusesImagesWithoutPointArrays) {
  const std::string empty = folder.put("empty.vti", vti(""));
  EXPECT_EQ(error_of([&] { read(empty); }), "cannot read '" + empty + "': the image has no scalars");
  const std::string cells =
      folder.put("cells.vti", vti("", R"(<DataArray type="UInt8" Name="heat" format="ascii">1 2</DataArray>)"));
  EXPECT_EQ(error_of([&] { read(cells); }),
            "cannot read '" + cells + "': the image has values in its cells, none at its points");
}

TEST_F(ReadImage, StructuredPointsAreAnImage) {
  const Dataset mesh = read(folder.put("a.vtk", R"(# vtk DataFile Version 3.0
by hand
ASCII
DATASET STRUCTURED_POINTS
DIMENSIONS 2 2 2
ORIGIN 0 0 0
SPACING 1 1 1
POINT_DATA 8
SCALARS heat float 1
LOOKUP_TABLE default
1 2 3 4 5 6 7 8
)"));
  EXPECT_EQ(test::tetrahedra_of(mesh), test::tetrahedra_of(make_grid(2)));
  EXPECT_EQ(values_of<float>(mesh.arrays[0]), (std::vector<float>{1, 2, 3, 4, 5, 6, 7, 8}));
}

const std::string mha = R"(ObjectType = Image
NDims = 3
BinaryData = True
BinaryDataByteOrderMSB = False
Offset = 1 2 3
ElementSpacing = 1 1 2
DimSize = 3 2 2
Favourite = this field is unknown
ElementType = MET_SHORT
ElementDataFile = )";

TEST_F(ReadImage, MetaImageWithItsData) {
  const std::string path = folder.put("a.mha", mha + "LOCAL\n" + bytes_of(Nifti().voxels));
  testing::internal::CaptureStderr();
  const Dataset mesh = read(path, above(0));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(names_of(mesh.arrays), std::vector<std::string>{"MetaImage"});
  EXPECT_EQ(values_of<std::int16_t>(mesh.arrays[0]), Nifti().voxels);
  const std::vector<double> points = points_of(mesh);
  EXPECT_EQ(std::vector<double>(points.end() - 3, points.end()), (std::vector<double>{3, 3, 5}));
}

TEST_F(ReadImage, MetaImageWithItsDataElsewhere) {
  folder.put("a.raw", bytes_of(Nifti().voxels));
  EXPECT_EQ(values_of<std::int16_t>(read(folder.put("a.mhd", mha + "a.raw\n")).arrays[0]), Nifti().voxels);
}

/// No side is below ten: VTK takes a first dimension of up to nine for components.
const std::string nrrd = "NRRD0004\ntype: float\ndimension: 3\nsizes: 10 2 2\nencoding: raw\nendian: little\n\n";

TEST_F(ReadImage, Nrrd) {
  std::vector<float> voxels(40);
  for (int i = 0; i < 40; ++i) voxels[i] = static_cast<float>(i + 1);
  const Dataset mesh = read(folder.put("a.nrrd", nrrd + bytes_of(voxels)), above(0));
  EXPECT_EQ(mesh.tetrahedra.extent(0), 54u);
  EXPECT_EQ(values_of<float>(mesh.arrays[0]), voxels);
}

TEST_F(ReadImage, NrrdSkipsLinesAndBytesOfEachFile) {
  const std::vector<std::uint8_t> voxels = {1, 2, 3, 4, 5, 6, 7, 8};
  const std::string heads[2] = {"head\n", "another\n"};
  for (int k = 0; k < 2; ++k)
    folder.put("t" + std::to_string(k) + ".raw", heads[k] + "ab" + bytes_of(voxels).substr(4 * k, 4));
  const auto content = [](const std::string& fields, const std::string& encoding = "raw") {
    return "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 2 2 2\nencoding: " + encoding + "\n" + fields;
  };
  const auto error = [&](const std::string& fields, const std::string& encoding = "raw") {
    const std::string path = folder.put("wrong.nrrd", content(fields, encoding));
    return error_of([&] { read(path); });
  };
  for (const std::string files : {"LIST\nt0.raw\nt1.raw\n", "t%d.raw 0 1 1\n"}) {
    for (const std::string skips :
         {"line skip: 1\nbyte skip: 2\n", "byte skip: -1\n", "line skip: 1\nbyte skip: -1\n"}) {
      const Dataset mesh = read(folder.put("a.nrrd", content(skips + "data file: " + files)));
      EXPECT_EQ(values_of<std::uint8_t>(mesh.arrays[0]), voxels) << skips << files;
    }
    EXPECT_NE(error("line skip: 3\ndata file: " + files).find("ends before the 3 lines to skip"), std::string::npos);
    EXPECT_NE(error("line skip: -3\ndata file: " + files).find("it skips -3 lines"), std::string::npos);
    EXPECT_NE(error("byte skip: -2\ndata file: " + files).find("it skips -2 bytes"), std::string::npos);
    EXPECT_NE(error("byte skip: 99\ndata file: " + files).find("not 4 from byte 99 on"), std::string::npos);
  }
  EXPECT_NE(error("byte skip: -1\n\n1 2 3 4 5 6 7 8", "text").find("its byte skip is -1"), std::string::npos);
  EXPECT_NE(error("byte skip: -1\n\nabc").find("has 3 bytes of values, not 8"), std::string::npos) << "no header's";
  EXPECT_NE(error("line skip: 1\nbyte skip: -1\n\nabc\n1234567").find("has 7 bytes of values"), std::string::npos);
  EXPECT_NE(error("line skip: 1\nbyte skip: -1\ndata file: LIST\nt0.raw\nt0.raw\n").find("t0.raw"), std::string::npos);
}

TEST_F(ReadImage, RefusesRowsOfVoxelsAndThresholdsThatNothingPasses) {
  Nifti row;
  row.dim = {2, 12, 1, 1, 1, 1, 1, 1};
  std::string path = folder.put("row.nii", row.bytes());
  EXPECT_EQ(error_of([&] { read(path); }),
            "cannot read '" + path + "': the image has 12 x 1 x 1 voxels: it needs at least 2 in two directions");
  path = folder.put("a.nii", Nifti().bytes());
  EXPECT_EQ(error_of([&] { read(path, above(300)); }),
            "cannot read '" + path + "': no eight neighbouring voxels of 'NIFTI' are all above 300");
}

TEST_F(ReadImage, RefusesDamagedFiles) {
  const std::string header = Nifti().bytes().substr(0, 352);
  const std::vector<std::pair<std::string, std::string>> files = {
      {"empty.nii", ""},
      {"text.nii", "hello\n"},
      {"short.nii", header + "abcd"},
      {"empty.nii.gz", ""},
      {"text.nii.gz", "hello\n"},
      {"short.nii.gz", header + "abcd"},
      {"empty.vti", ""},
      {"text.vti", "hello\n"},
      {"short.vti", vti(heat).substr(0, 300)},
      {"empty.mha", ""},
      {"text.mha", "hello\n"},
      {"short.mha", mha + "LOCAL\nabcd"},
      {"binary.mha", "\xff\x01=\n"},
      {"half.mha", mha.substr(0, 40)},
      {"none.mhd", mha + "none.raw\n"},
      {"empty.nrrd", ""},
      {"text.nrrd", "hello\n"},
      {"short.nrrd", nrrd + "abcd"},
  };
  for (const auto& [name, content] : files) {
    const std::string path = folder.put(name, content);
    const std::string start = "cannot read '" + path + "': it is damaged, incomplete or of another format (";
    const std::string message = error_of([&, path = path] { read(path); });
    EXPECT_EQ(message.substr(0, start.size()), start);
    EXPECT_GT(message.size(), start.size() + 5) << message;
  }
}

/// A real volume: Debian's mricron-data.
TEST_F(ReadImage, CountsOfARealVolume) {
  const std::string path = "/usr/share/mricron/templates/inia19-t1-brain.nii.gz";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "no " << path;
  const Dataset mesh = read(path, above(0));
  EXPECT_EQ(test::point_count_of(mesh), 873572u);
  EXPECT_EQ(mesh.tetrahedra.extent(0), 5008230u);
}

}  // namespace
}  // namespace gale::io
