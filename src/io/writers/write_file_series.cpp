#include <charconv>

#include <gale/io/bytes/output_file.hpp>
#include <gale/io/writers/writers.hpp>

namespace gale::io::detail {
namespace {

/// The text as JSON has it, in quotes.
std::string json_text(const std::string& text) {
  constexpr char digits[] = "0123456789abcdef";
  std::string quoted = "\"";
  for (const char c : text) {
    const auto code = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') quoted += '\\';
    if (code < 0x20) {
      quoted += std::string("\\u00") + digits[code / 16] + digits[code % 16];
    } else {
      quoted += c;
    }
  }
  return quoted + '"';
}

}  // namespace

void write_file_series(const AtomicFile& to, const std::vector<Step>& steps) {
  OutputFile file(to.temporary());
  file.write("{\n  \"file-series-version\" : \"1.0\",\n  \"files\" : [");
  const char* separator = "\n";
  for (const Step& step : steps) {
    char time[32];
    const auto end = std::to_chars(time, time + sizeof time, step.time).ptr;
    file.write(separator + ("    { \"name\" : " + json_text(step.file)) + ", \"time\" : " + std::string(time, end) +
               " }");
    separator = ",\n";
  }
  file.write("\n  ]\n}\n");
  file.flush();
}

}  // namespace gale::io::detail
