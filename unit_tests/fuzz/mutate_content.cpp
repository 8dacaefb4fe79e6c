#include <algorithm>
#include <cctype>
#include <cstring>
#include <utility>

#include "fuzz/mutate.hpp"
#include "fuzz/vocabulary.hpp"

namespace gale::fuzz {

namespace {

struct Span {
  std::size_t begin, size;
};

bool is_printable(char c) { return (c >= ' ' && c <= '~') || c == '\n' || c == '\r' || c == '\t'; }

/// Where the readable beginning ends: most headers, and all of ASCII files.
std::size_t header_end(const std::string& content) {
  std::size_t end = 0;
  while (end < content.size() && is_printable(content[end])) ++end;
  return end;
}

std::vector<Span> numbers_in(const std::string& content, std::size_t end) {
  std::vector<Span> found;
  const auto is_part = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) || c == '.' || c == '-'; };
  for (std::size_t i = 0; i < end;) {
    if (!is_part(content[i])) {
      ++i;
      continue;
    }
    std::size_t j = i;
    while (j < end && is_part(content[j])) ++j;
    found.push_back({i, j - i});
    i = j;
  }
  return found;
}

/// The parts between separators, and their own; the parts' ends are where headers can be cut and stuck together.
std::vector<Span> parts_in(const std::string& content, std::size_t end, char separator) {
  std::vector<Span> found;
  for (std::size_t i = 0; i < end;) {
    const std::size_t next = std::min(content.find(separator, i), end - 1);
    found.push_back({i, next + 1 - i});
    i = next + 1;
  }
  return found;
}

/// Attributes: ` name="value"`.
std::vector<Span> attributes_in(const std::string& content, std::size_t end) {
  std::vector<Span> found;
  for (std::size_t at = content.find("=\""); at != std::string::npos && at < end; at = content.find("=\"", at + 2)) {
    const std::size_t begin = content.rfind(' ', at), close = content.find('"', at + 2);
    if (begin != std::string::npos && close != std::string::npos) found.push_back({begin, close + 1 - begin});
  }
  return found;
}

std::string at(std::size_t position) { return " at " + std::to_string(position); }

std::string change_number(std::string& content, Random& random) {
  const auto all = numbers_in(content, header_end(content));
  if (all.empty()) return "";
  const Span span = random.one_of(all);
  std::string now = random.one_of(numbers);
  if (random.one_in(3)) {  // near what it was
    const long value = std::atol(content.substr(span.begin, std::min<std::size_t>(span.size, 16)).c_str());
    const long near[] = {value + 1, value - 1, value * 2, value / 2, -value, value + 4, value * 10, value + 64};
    now = std::to_string(near[random.below(std::size(near))]);
  }
  content.replace(span.begin, span.size, now);
  return "number " + now + at(span.begin);
}

std::string change_word(std::string& content, Random& random) {
  for (int attempt = 0; attempt < 20; ++attempt) {
    const auto& list = random.one_of(words);
    const std::string& old = random.one_of(list);
    std::vector<std::size_t> places;
    for (std::size_t i = content.find(old); i != std::string::npos; i = content.find(old, i + 1)) places.push_back(i);
    if (places.empty()) continue;
    const std::size_t place = random.one_of(places);
    const std::string& now = random.one_in(6) ? random.one_of(random.one_of(words)) : random.one_of(list);
    content.replace(place, old.size(), now);
    return old + " -> " + now + at(place);
  }
  return "";
}

/// Deletes, doubles or moves one of some parts, or puts another's content in its place.
std::string shuffle(std::string& content, const std::vector<Span>& parts, const char* name, Random& random) {
  if (parts.size() < 2) return "";
  const Span a = random.one_of(parts), b = random.one_of(parts);
  const std::string of_a = content.substr(a.begin, a.size), of_b = content.substr(b.begin, b.size);
  switch (random.below(4)) {
    case 0:
      content.erase(a.begin, a.size);
      return std::string("deleted ") + name + at(a.begin);
    case 1:
      content.insert(a.begin, of_a);
      return std::string("doubled ") + name + at(a.begin);
    case 2:
      content.replace(a.begin, a.size, of_b);
      return std::string("replaced ") + name + at(a.begin) + " by that" + at(b.begin);
    default:
      content.insert(b.begin, of_a);
      return std::string("copied ") + name + at(a.begin) + " to " + std::to_string(b.begin);
  }
}

std::string cut(std::string& content, Random& random) {
  const std::size_t end = header_end(content);
  std::size_t size = random.below(content.size() + 1);
  if (random.one_in(3)) size = content.size() - std::min(content.size(), 1 + random.below(16));
  if (random.one_in(3)) size = std::min(content.size(), end + random.below(3));
  if (random.one_in(4)) {
    const auto lines = parts_in(content, end, '\n');
    if (!lines.empty()) size = random.one_of(lines).begin;
  }
  content.resize(size);
  return "cut to " + std::to_string(size);
}

std::string splice(std::string& content, const std::string& other, Random& random) {
  const std::size_t from = random.below(other.size() + 1), place = random.below(content.size() + 1);
  if (random.one_in(2)) {
    content = content.substr(0, place) + other.substr(from);
    return "spliced" + at(place);
  }
  content.insert(place, other.substr(from, 1 + random.below(64)));
  return "inserted another's bytes" + at(place);
}

std::string noise(std::string& content, Random& random) {
  if (content.empty()) return "";
  const std::size_t count = 1 + random.below(8), end = random.one_in(2) ? content.size() : header_end(content);
  std::size_t place = 0;
  for (std::size_t i = 0; i < count; ++i) {
    place = random.below(std::max<std::size_t>(end, 1));
    content[place] = random.one_in(2) ? static_cast<char>(content[place] ^ (1 << random.below(8)))
                                      : static_cast<char>(random.next());
  }
  return "noise" + at(place);
}

/// A whole number as binary headers and data have them.
std::string change_binary(std::string& content, Random& random) {
  static const std::uint64_t values[] = {0,
                                         1,
                                         2,
                                         3,
                                         7,
                                         0x7f,
                                         0x80,
                                         0xff,
                                         0x100,
                                         0x7fff,
                                         0x8000,
                                         0xffff,
                                         0x10000,
                                         0x7fffffff,
                                         0x80000000,
                                         0xffffffff,
                                         0x100000000,
                                         0x7fffffffffffffff,
                                         0x8000000000000000,
                                         ~0ull};
  static constexpr std::size_t widths[] = {1, 2, 4, 8};
  const std::size_t width = widths[random.below(4)];
  if (content.size() < width) return "";
  const std::size_t start = random.one_in(3) ? 0 : std::min(header_end(content), content.size() - 1);
  std::size_t place =
      start + random.below(std::min<std::size_t>(content.size() - start, random.one_in(2) ? 400 : content.size()));
  if (random.one_in(2)) place = place / width * width;
  place = std::min(place, content.size() - width);
  const std::uint64_t value = values[random.below(std::size(values))];
  const bool is_big = random.one_in(3);
  for (std::size_t i = 0; i < width; ++i)
    content[place + (is_big ? width - 1 - i : i)] = static_cast<char>(value >> (8 * i));
  return "binary " + std::to_string(value) + " of " + std::to_string(width) + " bytes" + at(place);
}

std::string remove_or_repeat(std::string& content, Random& random) {
  const std::size_t place = random.below(content.size() + 1), size = 1 + random.below(random.one_in(2) ? 8 : 200);
  if (random.one_in(2)) {
    content.erase(std::min(place, content.size()), size);
    return "removed " + std::to_string(size) + at(place);
  }
  const std::string piece =
      random.one_in(2) ? content.substr(place, size) : std::string(size, " 0\n\0A\xff"[random.below(6)]);
  content.insert(place, piece);
  return "inserted " + std::to_string(piece.size()) + at(place);
}

}  // namespace

std::string mutate(std::string& content, const std::string& other, Random& random) {
  const std::size_t end = header_end(content);
  switch (random.below(16)) {
    case 0:
    case 1:
    case 2:
    case 3:
    case 4:
      return change_number(content, random);
    case 5:
    case 6:
      return change_word(content, random);
    case 7:
      return shuffle(content, attributes_in(content, content.size()), "attribute", random);
    case 8:
      return shuffle(content, parts_in(content, end, '\n'), "line", random);
    case 9:
      return shuffle(content, parts_in(content, end, random.one_in(2) ? ' ' : '>'), "part", random);
    case 10:
      return cut(content, random);
    case 11:
      return splice(content, other, random);
    case 12:
      return noise(content, random);
    case 13:
    case 14:
      return change_binary(content, random);
    default:
      return remove_or_repeat(content, random);
  }
}

}  // namespace gale::fuzz
