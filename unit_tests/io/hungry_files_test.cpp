#include <algorithm>
#include <ctime>
#include <filesystem>
#include <limits>

#include <gtest/gtest.h>

#include <gale/io/cells/join.hpp>
#include <gale/io/read.hpp>

#include "io/io_fixtures.hpp"

/// Files that would stand for more than they hold, were what is in them read as often as it is named; and such that
/// took a time which grew with its square.
namespace gale::io {
namespace {

using test::error_of;

class HungryFiles : public test::VtkTest {};

std::string vtu_of(const std::string& pieces, const std::string& behind = "") {
  return R"(<VTKFile type="UnstructuredGrid" version="1.0" byte_order="LittleEndian" header_type="UInt64"><UnstructuredGrid>)" +
         pieces + "</UnstructuredGrid>" + behind + "</VTKFile>";
}

std::string piece_of(const std::string& arrays = "") {
  return R"(<Piece NumberOfPoints="4" NumberOfCells="1"><PointData>)" + arrays +
         R"(</PointData><Points><DataArray type="Float32" NumberOfComponents="3">0 0 0 1 0 0 0 1 0 0 0 1</DataArray></Points><Cells>
<DataArray type="Int64" Name="connectivity">0 1 2 3</DataArray><DataArray type="Int64" Name="offsets">4</DataArray>
<DataArray type="UInt8" Name="types">10</DataArray></Cells></Piece>)";
}

std::string pvtu_of(const std::vector<std::string>& names) {
  std::string pieces;
  for (const std::string& name : names) pieces += "<Piece Source=\"" + name + "\"/>";
  return R"(<VTKFile type="PUnstructuredGrid" version="1.0" byte_order="LittleEndian"><PUnstructuredGrid GhostLevel="0">)" +
         pieces + "</PUnstructuredGrid></VTKFile>";
}

TEST_F(HungryFiles, PieceThatIsNamedTwice) {
  namespace fs = std::filesystem;
  folder.put("a.vtu", vtu_of(piece_of()));
  folder.put("b.vtu", vtu_of(piece_of()));
  fs::create_directory(folder / "inner");
  fs::create_symlink(folder / "a.vtu", folder / "symbolic.vtu");
  fs::create_hard_link(folder / "a.vtu", folder / "hard.vtu");
  EXPECT_EQ(read(folder.put("good.pvtu", pvtu_of({"a.vtu", "b.vtu"}))).tetrahedra.extent(0), 2u);
  for (const std::string again : {"a.vtu", "./a.vtu", "inner/../a.vtu", "symbolic.vtu", "hard.vtu"}) {
    const std::string path = folder.put("bad.pvtu", pvtu_of({"a.vtu", "b.vtu", again}));
    const std::string message = error_of([&] { read(path); });
    EXPECT_NE(message.find("'" + again + "' twice"), std::string::npos) << message;
  }
  // A rank that reads one of them alone is told, too.
  EXPECT_NE(error_of([&] {
              piece_names(folder.put("bad.pvtu", pvtu_of({"a.vtu", "./a.vtu"})));
            }).find("twice"),
            std::string::npos);
}

TEST_F(HungryFiles, SliceThatIsNamedTwice) {
  folder.put("slice.raw", "abcd");
  const std::string path = folder.put(
      "a.mhd", "NDims = 3\nDimSize = 2 2 2\nElementType = MET_UCHAR\nElementDataFile = LIST\nslice.raw\n./slice.raw\n");
  EXPECT_NE(error_of([&] { read(path); }).find("twice"), std::string::npos);
}

TEST_F(HungryFiles, ArraysThatLieOnEachOther) {
  const std::uint64_t bytes = 4 * 8;
  std::string values(sizeof bytes + bytes, '\0');
  std::copy_n(reinterpret_cast<const char*>(&bytes), sizeof bytes, values.begin());
  const std::string behind = "<AppendedData encoding=\"raw\">_" + values + "</AppendedData>";
  const auto file = [&](int arrays) {
    std::string all;
    for (int k = 0; k < arrays; ++k)
      all += R"(<DataArray type="Float64" Name="h)" + std::to_string(k) + R"(" format="appended" offset="0"/>)";
    return folder.put("a.vtu", vtu_of(piece_of(all), behind));
  };
  EXPECT_EQ(read(file(1)).arrays.size(), 1u);
  EXPECT_EQ(read(file(2)).arrays.size(), 2u);  // 64 bytes are no more than the file has
  // A hundred times 8000 bytes, of which the file has 8000 once.
  const std::uint64_t many = 1000 * 8;
  values.assign(sizeof many + many, '\0');
  std::copy_n(reinterpret_cast<const char*>(&many), sizeof many, values.begin());
  std::string all;
  for (int k = 0; k < 100; ++k)
    all += R"(<DataArray type="Float64" NumberOfComponents="250" Name="h)" + std::to_string(k) +
           R"(" format="appended" offset="0"/>)";
  const std::string path =
      folder.put("b.vtu", vtu_of(piece_of(all), "<AppendedData encoding=\"raw\">_" + values + "</AppendedData>"));
  const std::string message = error_of([&] { read(path); });
  EXPECT_NE(message.find("lies where other arrays do"), std::string::npos) << message;
}

#ifdef GALE_ENABLE_VTK  // else there are no readers, and what they are made of isn't there

/// Seconds of this process, the least of some runs.
template <class Work>
double seconds_of(const Work& work) {
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < 3; ++run) {
    const std::clock_t begin = std::clock();
    work();
    least = std::min(least, static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
  }
  return least;
}

/// Joins eight times as many, which takes eight times as long, and not 64 times.
template <class Join>
void expect_linear(const Join& join) {
  constexpr int count = 1000;
  const double one = seconds_of([&] { join(count); }), eight = seconds_of([&] { join(8 * count); });
  EXPECT_LT(eight, 24 * one) << one << " s";
}

detail::MeshParts small_piece() {
  detail::MeshParts parts;
  parts.points = std::vector<float>(12);
  parts.cells = {std::vector<std::uint8_t>{10}, std::vector<std::int64_t>{4}, std::vector<std::int64_t>{0, 1, 2, 3}};
  return parts;
}

TEST(JoinedPieces, ManyTakeAsLongAsTheyAre) {
  expect_linear([](int count) {
    detail::JoinedPieces joined;
    for (int k = 0; k < count; ++k) joined.add(small_piece());
    EXPECT_EQ(joined.points(), 4u * static_cast<unsigned>(count));
  });
}

TEST(JoinedPieces, ArraysOfOnePieceAloneTakeAsLongAsTheyAre) {
  expect_linear([](int count) {
    detail::JoinedPieces joined;
    for (const std::string name : {"first", "second"}) {
      detail::MeshParts parts = small_piece();
      for (int k = 0; k < count; ++k) parts.arrays.push_back({name + std::to_string(k), 1, std::vector<float>(4)});
      joined.add(std::move(parts));
    }
    EXPECT_EQ(joined.take().notices.size(), 2 * static_cast<std::size_t>(count));
  });
}

#endif

}  // namespace
}  // namespace gale::io
