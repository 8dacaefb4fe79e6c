#include <gale/app/critical_counts.hpp>

namespace gale::app {

void tell(const CriticalSimplices& critical, Session& session) {
  static const char* const names[] = {"minima", "1-saddles", "2-saddles", "maxima"};
  const auto counts = critical.counts();
  for (int dimension = 0; dimension < 4; ++dimension)
    session.console().say(names[dimension], grouped(counts[dimension]));
  session.console().say("Euler number", grouped(critical.euler()));
  session.report().result = {{"critical", counts}, {"euler", critical.euler()}};
}

}  // namespace gale::app
