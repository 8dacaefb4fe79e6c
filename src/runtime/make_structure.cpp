#include <gale/base/error.hpp>
#include <gale/runtime/defaults.hpp>
#include <gale/runtime/explicit/explicit_structure.hpp>
#include <gale/runtime/make_structure.hpp>
#include <gale/runtime/ways.hpp>

namespace gale {

namespace {

struct NamedWay {
  Way way;
  const char* name;
};

constexpr NamedWay named_ways[] = {
    {Way::gale, "gale"},      {Way::leaders, "leaders"},    {Way::helpers, "helpers"},
    {Way::inline_, "inline"}, {Way::explicit_, "explicit"},
};

std::unique_ptr<Structure> make(const Mesh& mesh, RelationSet wanted, const StructureOptions& options, Way way) {
  switch (way) {
    case Way::gale:
      return make(mesh, wanted, options, mesh.on_device() ? Way::leaders : Way::helpers);
    case Way::leaders:
      return detail::make_leader_structure(mesh, wanted, options);
    case Way::helpers:
      return detail::make_helped_structure(mesh, wanted, options);
    case Way::inline_:
      return std::make_unique<detail::InlineStructure>(mesh, wanted);
    case Way::explicit_:
      return std::make_unique<ExplicitStructure>(mesh, wanted);
  }
  throw Error("there is no such way of computing");
}

}  // namespace

const char* name_of(Way way) {
  for (const NamedWay& named : named_ways) {
    if (named.way == way) return named.name;
  }
  return "unknown";
}

std::optional<Way> way_named(const std::string& name) {
  for (const NamedWay& named : named_ways) {
    if (named.name == name) return named.way;
  }
  return std::nullopt;
}

std::unique_ptr<Structure> make_structure(const Mesh& mesh, RelationSet wanted, const StructureOptions& options) {
  detail::require_relations(wanted);
  require_relations(wanted, mesh.dimension());
  detail::require_counts(options);
  try {
    return make(mesh, wanted, options, options.way);
  } catch (const OutOfMemory& error) {
    if (!have_device || options.way == Way::helpers) throw;
    auto structure = make(mesh, wanted, options, Way::helpers);
    structure->add_notice(std::string("what computes relations doesn't fit the device's memory (") + error.missing() +
                          "): the host computes them");
    return structure;
  }
}

}  // namespace gale
