#include <algorithm>
#include <sstream>

#include <gale/io/bytes/damaged.hpp>

namespace gale::io::detail {

std::string printable(const std::string& text) {
  constexpr std::size_t longest = 200;
  std::istringstream words(text.substr(0, 4 * longest));
  std::string line;
  for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  if (line.size() > longest) line = line.substr(0, longest) + "...";
  return line;
}

}  // namespace gale::io::detail
