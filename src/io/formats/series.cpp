#include <algorithm>
#include <cmath>

#if defined(GALE_HAS_JSON)
#include <nlohmann/json.hpp>
#endif

#include <gale/io/bytes/text.hpp>
#include <gale/io/formats.hpp>
#include <gale/io/formats/volume.hpp>
#include <gale/io/formats/xml_file.hpp>

// Files that name others, each with a time.
namespace gale::io::detail {
namespace {

class Steps {
 public:
  Steps(const InputFile& input, const ReadOptions& options) : input_(input), options_(options) {}

  void add(double time, const std::string& file) {
    if (!std::isfinite(time)) damaged("the time of its file '", file, "' is ", time);
    if (steps_.size() == most_files) damaged("it names more than ", most_files, " files");
    const Format* const format = format_of(file);
    if (format == nullptr || format->reader == nullptr || format->input == Input::series)
      refuse("its file '", printable(file), "' is of no format that has a step");
    steps_.push_back({time, path_of_data(input_.path(), file, options_)});
  }

  /// All, in the order of their times.
  std::vector<Step> take() {
    if (steps_.empty()) damaged("it names no file");
    std::stable_sort(steps_.begin(), steps_.end(), [](const Step& a, const Step& b) { return a.time < b.time; });
    const auto same = [](const Step& a, const Step& b) { return a.time == b.time; };
    const auto twice = std::adjacent_find(steps_.begin(), steps_.end(), same);
    if (twice != steps_.end())
      refuse("it names two files at the time ", twice->time, ", '", printable(twice->file), "' and '",
             printable(twice[1].file), "': the pieces of a mesh are one file as a .pvtu");
    return std::move(steps_);
  }

 private:
  const InputFile& input_;
  const ReadOptions& options_;
  std::vector<Step> steps_;
};

}  // namespace

std::vector<Step> steps_of_pvd(const InputFile& input, const ReadOptions& options) {
  const XmlFile file = read_xml(input, "Collection");
  Steps steps(input, options);
  for (const XmlElement* const one : file.root.require("Collection").all("DataSet")) {
    const std::string text = one->attribute("timestep", "0");
    double time = 0;
    if (!parse(trimmed(text), time)) damaged("its timestep '", text, "' is no number");
    steps.add(time, one->attribute("file"));
  }
  return steps.take();
}

#if defined(GALE_HAS_JSON)

std::vector<Step> steps_of_file_series(const InputFile& input, const ReadOptions& options) {
  constexpr std::uint64_t most_bytes = 1 << 26;
  if (input.size() > most_bytes) damaged("it has ", input.size(), " bytes");
  std::string text(static_cast<std::size_t>(input.size()), '\0');
  input.read(0, text.data(), text.size());
  const auto all = nlohmann::json::parse(text, nullptr, false);
  const auto files = all.is_object() ? all.find("files") : all.end();
  if (files == all.end() || !files->is_array()) damaged("it is no JSON with a list of files");
  Steps steps(input, options);
  for (const auto& one : *files) {
    const bool is_file = one.is_object() && one.count("name") == 1 && one["name"].is_string() &&
                         (one.count("time") == 0 || one["time"].is_number());
    if (!is_file) damaged("its file ", &one - &*files->begin(), " has no name or no time");
    steps.add(one.value("time", 0.0), one["name"].get<std::string>());
  }
  return steps.take();
}

#else

std::vector<Step> steps_of_file_series(const InputFile&, const ReadOptions&) {
  throw Error("this gale was built without nlohmann_json, which reads it; a .pvd says the same");
}

#endif

namespace {

Content first_of(const std::vector<Step>& steps, const ReadOptions& options) {
  Content content = format_of(steps[0].file)->reader(InputFile(steps[0].file), options);
  if (steps.size() > 1) {
    const std::string notice = "took the first of " + std::to_string(steps.size()) + " time steps";
    std::visit([&](auto& one) { one.notices.push_back(notice); }, content);
  }
  return content;
}

}  // namespace

Content read_pvd(const InputFile& input, const ReadOptions& options) {
  return first_of(steps_of_pvd(input, options), options);
}

Content read_file_series(const InputFile& input, const ReadOptions& options) {
  return first_of(steps_of_file_series(input, options), options);
}

}  // namespace gale::io::detail
