#include <cstdio>

#include <gale/outputs/field.hpp>
#include <gale/outputs/table.hpp>

namespace gale::outputs {

std::string to_csv(const std::vector<io::PointArray>& columns) {
  std::string csv;
  for (const io::PointArray& column : columns) csv += (csv.empty() ? "" : ",") + column.name;
  for (std::size_t row = 0; !columns.empty() && row < io::point_count(columns[0]); ++row) {
    for (const io::PointArray& column : columns) {
      char number[32];
      std::snprintf(number, sizeof(number), "%.17g", value_at(column, static_cast<Id>(row)));
      csv += (&column == &columns[0] ? '\n' : ',') + std::string(number);
    }
  }
  return csv + '\n';
}

}  // namespace gale::outputs
