#include <cmath>
#include <cstdlib>
#include <memory>

#include <CLI/CLI.hpp>

#include <gale/app/commands/command.hpp>
#include <gale/outputs/field.hpp>
#include <gale/outputs/tracks.hpp>

namespace gale::app {

namespace {

/// "z" or "z:0.5".
outputs::Lift parse_lift(const std::string& text) {
  const bool has_axis = !text.empty() && text[0] >= 'x' && text[0] <= 'z' && (text.size() == 1 || text[1] == ':');
  outputs::Lift lift{has_axis ? text[0] - 'x' : 0, 1};
  char* end = nullptr;
  if (has_axis && text.size() > 1) lift.scale = std::strtod(text.c_str() + 2, &end);
  const bool is_number = text.size() == 1 || (text.size() > 2 && end != nullptr && *end == '\0');
  if (has_axis && is_number && std::isfinite(lift.scale)) return lift;
  throw UsageError("--lift: '" + text +
                   "' is no axis, such as z, nor one with what a unit of time adds to it, such as z:0.5");
}

void tell(const Tracks& tracks, Session& session) {
  std::int64_t begins[3] = {}, ends[3] = {};
  for (const Track& track : tracks.tracks) {
    ++begins[static_cast<int>(track.begin)];
    ++ends[static_cast<int>(track.end)];
  }
  session.tell("tracks", "tracks", static_cast<std::int64_t>(tracks.tracks.size()));
  session.tell("births", "births", begins[static_cast<int>(TrackBegin::birth)]);
  session.tell("splits", "splits", begins[static_cast<int>(TrackBegin::split)]);
  session.tell("merges", "merges", ends[static_cast<int>(TrackEnd::merge)]);
  session.tell("deaths", "deaths", ends[static_cast<int>(TrackEnd::death)]);
}

class TrackExtrema final : public AnalysisCommand {
 public:
  explicit TrackExtrema(CLI::App& app) : AnalysisCommand(app, outputs::tracking()) {
    add_file("-o,--output", output_, "Write a line through time for each track, merge and split: {}",
             io::written_surfaces);
    add_file("--table", table_, analysis_.option("table").help + ": {}", io::written_tables);
    add_persistence();
    subcommand()
        .add_option_function<std::string>(
            "--lift", [this](const std::string& text) { lift_ = parse_lift(text); }, analysis_.option("lift").help)
        ->type_name("AXIS[:SCALE]");
  }

 private:
  Session::Outputs outputs() const override { return Session::Outputs::of_all_steps; }
  Session::Keep keep() const override { return Session::Keep::values; }

  void go_through_steps(Session& session, Computed& computed) const override {
    if (!session.is_series())
      throw UsageError("'" + input().inputs.front() + "' is no series: gale track follows extrema from step to step");
    ExtremumTracker tracker;
    outputs::TrackLines lines;
    bool goes_on = true;
    while (goes_on) {
      const FieldOnMesh on = session.read_field(segmentation_, keep());
      const double least = threshold_for(on.field);
      const DiscreteGradient gradient =
          find_discrete_gradient(on.order, session.compute(structure_, "gradient"), &computed);
      const SweepOptions sweep = session.sweep("tracks");
      timed(session.report().seconds.run, [&] {
        const auto values = std::make_shared<const io::PointArray>(on.field);
        tracker.add(
            session.time(), gradient, [values](Id v) { return outputs::value_at(*values, v); }, least, sweep.threads);
        if (!output_.empty()) lines.add(on.dataset, on.field, tracker.tracks());
      });
      tell_step(tracker.tracks(), session);
      goes_on = session.next_step(computed);
    }
    tell(tracker.tracks(), session);
    session.write(output_,
                  [&](const io::AtomicFile& file) { io::write_surface(file, lines.lines(tracker.tracks(), lift_)); });
    session.write(table_,
                  [&](const io::AtomicFile& file) { write_table(file, outputs::track_table(tracker.tracks())); });
  }

  static void tell_step(const Tracks& tracks, Session& session) {
    std::int64_t counts[2] = {};
    for (Id i = tracks.step_begin[tracks.times.size() - 1]; i < tracks.step_begin.back(); ++i)
      ++counts[tracks.extrema[i].is_maximum ? 1 : 0];
    session.tell("minima", "minima", counts[0]);
    session.tell("maxima", "maxima", counts[1]);
  }

  std::optional<outputs::Lift> lift_;
  std::string output_, table_;
};

}  // namespace

std::unique_ptr<Command> add_track(CLI::App& app) { return std::make_unique<TrackExtrema>(app); }

}  // namespace gale::app
