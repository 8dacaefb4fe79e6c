#include <set>
#include <sstream>
#include <string>

#include <gtest/gtest.h>

#include <gale/io/formats.hpp>

#include "io/io_fixtures.hpp"

/// The table of formats agrees with itself, and pages with it.
namespace gale::io {
namespace {

using test::content_of;

std::vector<std::string> words_of(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::string written_with(const Format& format) {
  static const char* const names[] = {
      "points", "surfaces", "lines",  "meshes",  "pieces of meshes", "meshes of triangles",
      "arrows", "series",   "tables", "pictures"};
  std::string list;
  for (unsigned bit = 0; bit < 10; ++bit) {
    if ((format.written >> bit & 1) != 0) list += (list.empty() ? "" : ", ") + std::string(names[bit]);
  }
  return list;
}

/// A row of the table in docs/formats.md.
std::string row_of(const Format& format) {
  const char* const inputs[] = {"", "a mesh", "a volume", "a series"};
  std::string row = "|";
  for (const std::string& cell :
       {std::string(format.name), "`" + std::string(format.extensions) + "`",
        std::string(inputs[static_cast<int>(format.input)]), written_with(format), std::string(format.about)}) {
    row += cell.empty() ? " |" : " " + cell + " |";
  }
  return row;
}

std::string page(const std::string& path) { return content_of(GALE_SOURCE "/" + path); }

TEST(Formats, NoTwoHaveAnExtension) {
  std::set<std::string> all;
  for (const Format& format : formats()) {
    for (const std::string& extension : words_of(format.extensions)) EXPECT_TRUE(all.insert(extension).second);
  }
}

TEST(Formats, AreReadOrWritten) {
  for (const Format& format : formats()) {
    EXPECT_TRUE(format.reader != nullptr || format.written != 0) << format.name;
    EXPECT_EQ(format.reader != nullptr, format.input != Input::none) << format.name;
    EXPECT_EQ(format.reader != nullptr, *format.about != '\0') << format.name;
  }
}

TEST(Formats, HaveWritersOfWhatIsWrittenToThem) {
  for (const Format& format : formats()) {
    const bool has_writer = std::visit([](auto* writer) { return writer != nullptr; }, format.writer);
    EXPECT_EQ(has_writer, format.takes(~unsigned(written_pictures))) << format.name;
    if (format.pieces != nullptr) {
      EXPECT_TRUE(format_of(std::string("a") + format.pieces)->takes(format.written)) << format.name;
    }
  }
}

TEST(Formats, SayWhichExtensionsResultsMayHave) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(extensions_written(written_points), (Names{".vtp", ".vtkhdf"}));
  EXPECT_EQ(extensions_written(written_meshes | written_triangles), (Names{".vtu", ".vtk", ".vtkhdf", ".vtp"}));
  EXPECT_EQ(extensions_written(written_arrows), Names{".vtp"});
  EXPECT_EQ(extensions_written(written_tables), (Names{".csv", ".npz"}));
  EXPECT_EQ(extensions_written(written_points, true), Names{".pvtp"});
  EXPECT_EQ(extensions_written(written_meshes | written_pieces, true), Names{".pvtu"});
  EXPECT_EQ(extensions_written(written_lines, true), (Names{".vtu", ".vtkhdf"})) << "which has no pieces";
  EXPECT_EQ(extensions_written(0), Names{});
}

TEST(Formats, SayWhatNamesTheirFilesOfSeveralSteps) {
  EXPECT_EQ(format_of("a.vtu")->series("b/a.vtu"), "b/a.pvd");
  EXPECT_EQ(format_of("a.PVTP")->series("a.PVTP"), "a.pvd");
  EXPECT_EQ(format_of("a.VTKHDF")->series("a.VTKHDF"), "a.VTKHDF.series");
  EXPECT_EQ(format_of("a.vtk")->series, nullptr);
}

TEST(Formats, AreFoundByTheirExtensionsInEitherCase) {
  for (const Format& format : formats()) {
    for (const std::string& extension : words_of(format.extensions)) EXPECT_EQ(format_of("a" + extension), &format);
  }
  EXPECT_EQ(format_of("A.NII.GZ"), format_of("a.nii"));
  EXPECT_EQ(format_of("a.msh"), nullptr);
  EXPECT_EQ(format_of(".vtu"), nullptr) << "this is a name without an extension";
}

TEST(Formats, AreTheTableOfTheirPage) {
  std::string table = "|---|---|---|---|---|\n";
  for (const Format& format : formats()) table += row_of(format) + "\n";
  EXPECT_NE(page("docs/formats.md").find(table + "\n"), std::string::npos) << "its table should be\n" << table;
}

TEST(Formats, AreNamedWhereverInputsAre) {
  for (const std::string path : {"README.md", "docs/command.md", "bindings/python/gale/_mesh.py"}) {
    const std::string text = page(path);
    for (const Format& format : formats()) {
      if (format.reader == nullptr) continue;
      for (const std::string& extension : words_of(format.extensions)) {
        std::size_t at = text.find(extension);
        while (at != std::string::npos && std::isalnum(static_cast<unsigned char>(text[at + extension.size()])) != 0)
          at = text.find(extension, at + 1);
        EXPECT_NE(at, std::string::npos) << path << " doesn't name " << extension;
      }
    }
  }
}

}  // namespace
}  // namespace gale::io
