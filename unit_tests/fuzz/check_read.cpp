#include "fuzz/check_read.hpp"

#include <chrono>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <optional>

#include <gale/base/error.hpp>

#include "fuzz/memory_watch.hpp"

namespace gale::fuzz {

namespace {

bool last_was_read = false;

struct Outcome {
  std::optional<io::Dataset> dataset;
  std::string message, complaint;
};

/// How many bytes the file can stand for.
std::size_t can_hold(const Case& one) {
  const std::string all = one.content + one.companion;
  // HDF5 says in a number whether it packs.
  const auto has = [&](const std::string& text) { return all.find(text) != std::string::npos; };
  const bool is_packed = has("\x1f\x8b") || has("compressor") || has("Compress") || has("gz") || has("x\x9c") ||
                         has("BZh") || has("\x89HDF");
  return all.size() * (is_packed ? 1032 : 1);
}

Outcome read_once(const std::string& path, const io::ReadOptions& options, unsigned char fill, std::size_t limit) {
  Outcome outcome;
  outcome.message.reserve(1000);
  // Fresh memory of programs that read for us has these bytes; malloc fills it with the complement.
  setenv("GLIBC_TUNABLES", ("glibc.malloc.perturb=" + std::to_string(fill)).c_str(), 1);
  const auto begin = std::chrono::steady_clock::now();
  {
    const MemoryWatch watch(fill, limit);
    try {
      outcome.dataset = io::read(path, options);
    } catch (const Error& error) {
      outcome.message = error.what();
    } catch (const std::bad_alloc&) {
      outcome.message = "std::bad_alloc";
    } catch (const std::exception& error) {
      outcome.complaint = std::string("an exception of another type: ") + error.what();
    }
    if (MemoryWatch::refused()) {
      outcome.complaint = "it wants more memory than " + std::to_string(limit) + " bytes";
    } else if (outcome.message == "std::bad_alloc") {
      outcome.complaint = "it ran out of memory";
    }
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  if (outcome.complaint.empty() && seconds > 5) outcome.complaint = "it took " + std::to_string(seconds) + " s";
  return outcome;
}

std::string complaint_about_message(const std::string& message, const std::string& path) {
  if (message.find(path) == std::string::npos) return "a message that doesn't name the file: " + message;
  for (const char c : message) {
    if (static_cast<unsigned char>(c) < ' ' || c == 127) return "a message with a control character: " + message;
  }
  return message.size() > 1000 ? "a message of " + std::to_string(message.size()) + " characters" : "";
}

std::string complaint_about_dataset(const io::Dataset& dataset) {
  const std::size_t points = std::visit([](const auto& p) { return p.extent(0); }, dataset.points);
  if (dataset.cells() == 0) return "no tetrahedra and no triangles";
  if (dataset.tetrahedra.extent(0) > 0 && dataset.triangles.extent(0) > 0) return "tetrahedra and triangles";
  const auto has_other_id = [points](const auto& cells) {
    for (std::size_t k = 0; k < cells.size(); ++k) {
      const std::int32_t id = cells.data()[k];
      if (id < 0 || static_cast<std::size_t>(id) >= points) return true;
    }
    return false;
  };
  if (has_other_id(dataset.tetrahedra) || has_other_id(dataset.triangles)) return "an id that no point has";
  for (const auto& array : dataset.cell_arrays) {
    if (io::point_count(array) != dataset.cells()) return "a cell array of another length";
  }
  for (const auto& array : dataset.arrays) {
    const std::size_t values = std::visit([](const auto& v) { return v.size(); }, array.values);
    if (array.components < 1 || values != points * array.components) return "an array of another length";
  }
  return "";
}

template <class T>
bool same_bytes(const T* a, const T* b, std::size_t count) {
  return count == 0 || std::memcmp(a, b, count * sizeof(T)) == 0;
}

bool same(const io::PointArray& a, const io::PointArray& b) {
  if (a.name != b.name || a.components != b.components || a.values.index() != b.values.index()) return false;
  return std::visit(
      [&](const auto& values) {
        const auto& others = std::get<std::decay_t<decltype(values)>>(b.values);
        return values.size() == others.size() && same_bytes(values.data(), others.data(), values.size());
      },
      a.values);
}

bool same(const io::Dataset& a, const io::Dataset& b) {
  if (a.points.index() != b.points.index() || a.arrays.size() != b.arrays.size() || a.notices != b.notices)
    return false;
  const bool same_points = std::visit(
      [&](const auto& points) {
        const auto& others = std::get<std::decay_t<decltype(points)>>(b.points);
        return points.extent(0) == others.extent(0) && same_bytes(points.data(), others.data(), points.extent(0) * 3);
      },
      a.points);
  if (!same_points || a.tetrahedra.extent(0) != b.tetrahedra.extent(0)) return false;
  if (!same_bytes(a.tetrahedra.data(), b.tetrahedra.data(), a.tetrahedra.extent(0) * 4)) return false;
  if (a.triangles.extent(0) != b.triangles.extent(0)) return false;
  if (!same_bytes(a.triangles.data(), b.triangles.data(), a.triangles.extent(0) * 3)) return false;
  for (std::size_t i = 0; i < a.arrays.size(); ++i) {
    if (!same(a.arrays[i], b.arrays[i])) return false;
  }
  return true;
}

}  // namespace

bool was_read() { return last_was_read; }

std::string complaint_about(const Case& one, const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / ("input" + one.extension), companion = folder / "input.raw";
  put(file, one.content);
  if (one.companion.empty()) {
    std::filesystem::remove(companion);
  } else {
    put(companion, one.companion);
  }
  last_was_read = false;
  const std::size_t limit = (std::size_t(64) << 20) + 10 * can_hold(one);
  const Outcome a = read_once(file.string(), one.options, 0x11, limit);
  if (!a.complaint.empty()) return a.complaint;
  const Outcome b = read_once(file.string(), one.options, 0xEE, limit);
  if (!b.complaint.empty()) return b.complaint;
  if (a.dataset.has_value() != b.dataset.has_value()) return "read with other bytes in fresh memory, it ends otherwise";
  if (!a.dataset) {
    if (a.message != b.message) return "read with other bytes in fresh memory, it says something else: " + a.message;
    return complaint_about_message(a.message, file.string());
  }
  last_was_read = true;
  if (!same(*a.dataset, *b.dataset)) return "read with other bytes in fresh memory, it is another dataset";
  return complaint_about_dataset(*a.dataset);
}

}  // namespace gale::fuzz
