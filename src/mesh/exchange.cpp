#include <gale/base/parallel.hpp>
#include <gale/mesh/exchange.hpp>
#include <gale/mesh/exchange/exchange_plan.hpp>

namespace gale {

namespace {

/// Has every value where it is.
const detail::ExchangePlan& plan_of_nothing() {
  static const detail::ExchangePlan plan;
  return plan;
}

}  // namespace

const Exchange& Exchange::of_whole_mesh() {
  static const Exchange whole;
  return whole;
}

Array<int, HostMemory> Exchange::owners_of(const Array<const GlobalId, HostMemory>& ids) const {
  const auto owners = allocate<Array<int, HostMemory>>("GALE::owners", ids.extent(0));
  fill("GALE::owners", HostExecutionSpace(), owners, 0);
  return owners;
}

const detail::ExchangePlan& Exchange::from_givers() const { return plan_of_nothing(); }
const detail::ExchangePlan& Exchange::from_owners() const { return plan_of_nothing(); }

}  // namespace gale
