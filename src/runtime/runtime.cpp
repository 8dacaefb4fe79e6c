#include <gale/base/error.hpp>
#include <gale/runtime/implementation.hpp>
#include <gale/runtime/runtime.hpp>

namespace gale {

namespace {

std::unique_ptr<detail::RuntimeImplementation> implement(const Mesh& mesh, RelationSet wanted,
                                                         const RuntimeOptions& options) {
  switch (options.way) {
    case Way::automatic:
      return have_device ? detail::by_leaders(mesh, wanted, options) : detail::by_helpers(mesh, wanted, options);
    case Way::leaders:
      return detail::by_leaders(mesh, wanted, options);
    case Way::inline_:
      return detail::by_consumers(mesh, wanted);
    case Way::helpers:
      return detail::by_helpers(mesh, wanted, options);
    case Way::task_parallel:
      return detail::by_pairs(mesh, wanted);
  }
  throw Error("there is no such way of computing");
}

}  // namespace

Runtime::Runtime(const Mesh& mesh, RelationSet wanted, const RuntimeOptions& options) {
  if (wanted.empty()) throw Error("a runtime needs at least one relation to be preconditioned for");
  implementation_ = implement(mesh, wanted, options);
}

Runtime::~Runtime() = default;

const Mesh& Runtime::mesh() const { return implementation_->mesh(); }
RelationSet Runtime::relations() const { return implementation_->relations(); }
Way Runtime::way() const { return implementation_->way(); }
RuntimeStatistics Runtime::statistics() const { return implementation_->statistics(); }

void Runtime::for_each_segment(RelationSet wanted, const SweepOptions& options, const SegmentBody& body) {
  require_preconditioned(relations(), wanted);
  implementation_->for_each_segment(wanted, options, body);
}

std::unique_ptr<Consumer> Runtime::consumer() { return implementation_->consumer(); }

}  // namespace gale
