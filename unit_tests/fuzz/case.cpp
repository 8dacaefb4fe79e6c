#include "fuzz/case.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>

namespace gale::fuzz {

namespace fs = std::filesystem;

namespace {

std::string extension_of(const fs::path& file) {
  const fs::path last = file.extension();
  return last == ".gz" ? file.stem().extension().string() + ".gz" : last.string();
}

}  // namespace

std::string content_of(const fs::path& file) {
  std::ostringstream content;
  content << std::ifstream(file, std::ios::binary).rdbuf();
  return content.str();
}

void put(const fs::path& file, const std::string& content) { std::ofstream(file, std::ios::binary) << content; }

Case load(const fs::path& file) {
  Case one;
  one.extension = extension_of(file);
  one.content = content_of(file);
  const fs::path companion = file.string() + ".raw";
  if (fs::exists(companion)) one.companion = content_of(companion);
  return one;
}

fs::path save(const Case& one, const fs::path& file) {
  const fs::path named = file.string() + one.extension;
  put(named, one.content);
  if (!one.companion.empty()) put(named.string() + ".raw", one.companion);
  return named;
}

std::vector<fs::path> files_in(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string extension = entry.path().extension().string();
    if (extension != ".raw" && extension != ".md" && extension != ".txt") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace gale::fuzz
