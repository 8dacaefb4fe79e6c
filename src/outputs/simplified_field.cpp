#include <gale/outputs/simplified_field.hpp>

namespace gale::outputs {

std::vector<io::PointArray> simplified_arrays(const io::PointArray& field, const SimplifiedField& simplified) {
  return {io::gather(field, simplified.value_of), {field.name + "_Order", 1, simplified.rank}};
}

}  // namespace gale::outputs
