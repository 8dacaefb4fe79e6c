#include <string>

#include <gale/app/ranks/ranks.hpp>
#include <gale/base/error.hpp>

namespace gale::app {

Launch::Launch(int&, char**&) {
  if (launched_ranks() == 1) return;
  throw Error("it was started on " + std::to_string(launched_ranks()) +
              " ranks, but built without MPI: build it with GALE_ENABLE_MPI=ON");
}
Launch::~Launch() = default;

const Ranks& Launch::ranks() { return Ranks::alone(); }
int Launch::threads(int alone) { return alone; }
void Launch::require_same_arguments(int, char**) {}
void Launch::end_all(int, bool) {}
bool Launch::all_fail_alike() { return true; }

FieldOnMesh read_on_ranks(const InputOptions&, int, const WantedOfInput&,
                          const std::function<void(const std::vector<std::string>&)>&) {
  throw Error("there are no ranks to share it");
}

}  // namespace gale::app
