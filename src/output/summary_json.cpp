#include "output/summary_json.hpp"

#include <cstdio>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "output/text_file.hpp"

namespace cinch {
namespace {

using Json = nlohmann::ordered_json;  // keeps the order of the fields as written here

std::string hash_text(std::uint64_t hash) {
  char text[24];
  std::snprintf(text, sizeof text, "0x%016llx", static_cast<unsigned long long>(hash));
  return text;
}

Json energy_json(const Summary& summary) {
  Json energy = Json::object();
  const auto values = summary.energy.values();
  for (std::size_t i = 0; i < values.size(); ++i) energy[Energies::names()[i]] = values[i];
  energy["initial"] = summary.energy_initial;
  energy["relative_residual"] = summary.relative_residual;
  return energy;
}

Json momentum_json(const Summary& summary) {
  Json momentum{{"linear_drift", summary.linear_momentum_drift}, {"angular_drift", nullptr}};
  if (summary.angular_momentum_drift) momentum["angular_drift"] = *summary.angular_momentum_drift;
  return momentum;
}

Json stages_json(const std::vector<StageTime>& stages) {
  double total = 0;
  for (const StageTime& stage : stages) total += stage.seconds;
  Json list = Json::array();
  for (const StageTime& stage : stages) {
    const double share = total > 0 ? stage.seconds / total : 0;
    list.push_back({{"name", stage.name}, {"seconds", stage.seconds}, {"share", share}});
  }
  return list;
}

Json events_json(const std::vector<Event>& events) {
  Json list = Json::array();
  for (const Event& event : events) {
    list.push_back({{"time", event.time}, {"kind", event.kind}, {"name", event.name}});
  }
  return list;
}

// A time below zero means never.
Json time_or_null(double time) { return time < 0 ? Json(nullptr) : Json(time); }

Json rings_json(const std::vector<RingRecord>& records) {
  Json list = Json::array();
  for (const RingRecord& ring : records) {
    list.push_back({{"name", ring.name},
                    {"first_contact_time", time_or_null(ring.first_contact_time)},
                    {"first_contact_force", ring.first_contact_force},
                    {"peak_force", ring.peak_force},
                    {"peak_time", time_or_null(ring.peak_time)}});
  }
  return list;
}

Json history_json(const std::vector<Pace>& history) {
  Json list = Json::array();
  for (const Pace& pace : history)
    list.push_back({{"time", pace.time}, {"fastest_node", pace.node}, {"speed", pace.speed}});
  return list;
}

double real(const Json& object, const char* name) {
  const Json& value = object.at(name);
  return value.is_null() ? std::numeric_limits<double>::quiet_NaN() : value.get<double>();
}

double time_or_never(const Json& object, const char* name) {
  return object.at(name).is_null() ? -1 : object.at(name).get<double>();
}

void read_program(const Json& json, Summary& summary) {
  json.at("status").get_to(summary.status);
  json.at("message").get_to(summary.message);
  if (json.contains("warnings"))
    json.at("warnings").get_to(summary.warnings);  // results before it was written
  json.at("case").get_to(summary.case_name);
  json.at("version").get_to(summary.version);
  json.at("commit").get_to(summary.commit);
  json.at("compiler").get_to(summary.compiler);
  json.at("isa").get_to(summary.isa);
  json.at("host").get_to(summary.host);
  json.at("threads").get_to(summary.threads);
  json.at("steps").get_to(summary.steps);
  json.at("nodes").get_to(summary.nodes);
  json.at("elements").get_to(summary.elements);
  json.at("ring_count").get_to(summary.rings);
  summary.time_step = real(json, "time_step");
  summary.closing_time_step = json.value("closing_time_step", summary.time_step);  // older results have none
  summary.joint_steps = json.value("joint_steps", 1);                              // older results have none
  summary.simulated_seconds = real(json, "simulated_seconds");
  summary.wall_seconds = real(json, "wall_seconds");
  summary.stable_step = real(json, "stable_step");
  json.at("stable_step_limited_by").get_to(summary.stable_step_limited_by);
  summary.state_hash = std::strtoull(json.at("state_hash").get<std::string>().c_str(), nullptr, 16);
}

void read_verdict(const Json& json, Summary& summary) {
  const Json& energy = json.at("energy");
  std::vector<double> terms;
  for (const std::string& name : Energies::names()) terms.push_back(real(energy, name.c_str()));
  summary.energy = Energies::from_values(terms);
  summary.energy_initial = real(energy, "initial");
  summary.relative_residual = real(energy, "relative_residual");
  const Json& momentum = json.at("momentum");
  summary.linear_momentum_drift = real(momentum, "linear_drift");
  if (!momentum.at("angular_drift").is_null()) {
    summary.angular_momentum_drift = momentum.at("angular_drift").get<double>();
  }
  summary.max_penetration = real(json, "max_penetration");
}

void read_lists(const Json& json, Summary& summary) {
  for (const Json& stage : json.at("stages")) {
    summary.stages.push_back({stage.at("name").get<std::string>(), real(stage, "seconds")});
  }
  for (const Json& event : json.at("events")) {
    summary.events.push_back(
        {real(event, "time"), event.at("kind").get<std::string>(), event.at("name").get<std::string>()});
  }
  for (const Json& ring : json.at("rings")) {
    summary.ring_records.push_back(
        {ring.at("name").get<std::string>(), time_or_never(ring, "first_contact_time"),
         real(ring, "first_contact_force"), real(ring, "peak_force"), time_or_never(ring, "peak_time")});
  }
  if (!json.contains("history")) return;  // results before it was written
  for (const Json& pace : json.at("history"))
    summary.history.push_back(
        {real(pace, "time"), pace.at("fastest_node").get<std::string>(), real(pace, "speed")});
}

}  // namespace

std::string summary_to_json(const Summary& summary) {
  Json json{{"status", summary.status},
            {"message", summary.message},
            {"warnings", summary.warnings},
            {"case", summary.case_name},
            {"version", summary.version},
            {"commit", summary.commit},
            {"compiler", summary.compiler},
            {"isa", summary.isa},
            {"host", summary.host},
            {"threads", summary.threads},
            {"steps", summary.steps},
            {"time_step", summary.time_step},
            {"closing_time_step", summary.closing_time_step},
            {"joint_steps", summary.joint_steps},
            {"simulated_seconds", summary.simulated_seconds},
            {"wall_seconds", summary.wall_seconds},
            {"minutes_per_simulated_second", summary.minutes_per_simulated_second()},
            {"nodes", summary.nodes},
            {"elements", summary.elements},
            {"ring_count", summary.rings},
            {"stable_step", summary.stable_step},
            {"stable_step_limited_by", summary.stable_step_limited_by},
            {"state_hash", hash_text(summary.state_hash)},
            {"energy", energy_json(summary)},
            {"momentum", momentum_json(summary)},
            {"max_penetration", summary.max_penetration},
            {"stages", stages_json(summary.stages)},
            {"events", events_json(summary.events)},
            {"rings", rings_json(summary.ring_records)},
            {"history", history_json(summary.history)}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

Summary summary_from_json(std::string_view text, const std::string& where) {
  try {
    const Json json = Json::parse(text);
    Summary summary;
    read_program(json, summary);
    read_verdict(json, summary);
    read_lists(json, summary);
    return summary;
  } catch (const nlohmann::json::exception& error) {
    throw FileError(where + ": not a Cinch summary: " + error.what());
  }
}

Summary read_summary(const std::filesystem::path& file) {
  return summary_from_json(read_text_file(file), file.string());
}

}  // namespace cinch
