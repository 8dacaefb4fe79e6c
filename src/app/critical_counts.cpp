#include <gale/algorithms/critical_points.hpp>
#include <gale/app/critical_counts.hpp>

namespace gale::app {

void tell_points(const std::array<std::int64_t, 5>& counts, Session& session) {
  static const struct {
    CriticalType type;
    const char *name, *key;
  } kinds[] = {{CriticalType::minimum, "minima", "minima"},
               {CriticalType::saddle1, "1-saddles", "saddles1"},
               {CriticalType::saddle2, "2-saddles", "saddles2"},
               {CriticalType::maximum, "maxima", "maxima"},
               {CriticalType::degenerate, "degenerate", "degenerate"}};
  for (const auto& kind : kinds) {
    const std::int64_t count = counts[static_cast<int>(kind.type)];
    session.console().say(kind.name, grouped(count));
    session.report().result[kind.key] = count;
  }
}

void tell_simplices(const std::array<std::int64_t, 4>& counts, Session& session) {
  static const char* const names[] = {"minima", "1-saddles", "2-saddles", "maxima"};
  for (int dimension = 0; dimension < 4; ++dimension)
    session.console().say(names[dimension], grouped(counts[dimension]));
  const std::int64_t euler = counts[0] - counts[1] + counts[2] - counts[3];
  session.console().say("Euler number", grouped(euler));
  session.report().result = {{"critical", counts}, {"euler", euler}};
}

}  // namespace gale::app
