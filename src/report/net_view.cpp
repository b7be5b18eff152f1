#include "report/net_view.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "report/chains.hpp"
#include "report/html.hpp"

namespace cinch {
namespace {

constexpr int kMostFrames = 60, kFewestFrames = 6;
constexpr std::size_t kMostBytes = 3'000'000;  // of coordinates in base64
constexpr std::size_t kMostNodes = 65535;      // node numbers have 16 bits
constexpr std::size_t kMostElements = 6000;
constexpr double kSteps = 65000;  // of a coordinate over the scene's size

using Json = nlohmann::json;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

/// Bytes in the page's order (little-endian, as every browser's typed arrays are in practice).
struct Bytes {
  std::vector<std::uint8_t> data;
  void u8(int value) { data.push_back(static_cast<std::uint8_t>(value)); }
  void u16(long value) {
    data.push_back(static_cast<std::uint8_t>(value & 255));
    data.push_back(static_cast<std::uint8_t>((value >> 8) & 255));
  }
  std::string text() const { return html::base64(data); }
};

// Evenly spread; fewer where a frame takes many bytes.
std::vector<int> chosen_frames(int frames, std::size_t bytes_each) {
  std::vector<int> chosen;
  const int fitting =
      static_cast<int>(std::min<std::size_t>(kMostBytes / std::max<std::size_t>(bytes_each, 1), kMostFrames));
  const int count = std::min(frames, std::max(fitting, kFewestFrames));
  for (int i = 0; i < count; ++i)
    chosen.push_back(count == 1 ? 0 : static_cast<int>(std::lround(double(i) * (frames - 1) / (count - 1))));
  return chosen;
}

Json numbers(const Vec3& v) { return {v.x(), v.y(), v.z()}; }

/// The elements and nodes that are shown, and the box that holds them in all frames.
struct Shown {
  std::vector<Index> elements, nodes;
  std::vector<Index> number;  ///< of each node among those shown, or -1
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  double size = 1e-9;

  Shown(const ResultModel& model, const Frame& first) : number(first.position.size(), -1) {
    for (const Chain& chain : chosen_chains(element_chains(model, first.position), kMostElements)) {
      elements.insert(elements.end(), chain.elements.begin(), chain.elements.end());
      for (const Index node : chain.nodes) add(node);
    }
    for (const auto& mass : model.masses) add(mass.node);
  }
  void add(Index node) {
    if (number[at(node)] >= 0) return;
    number[at(node)] = static_cast<Index>(nodes.size());
    nodes.push_back(node);
  }
  std::size_t bytes_of_a_frame(const ResultModel& model) const {
    return (6 * nodes.size() + elements.size() + 12 * model.rings.size() + 8 * model.joints.size()) * 4 / 3;
  }
  void fit(const std::vector<Frame>& frames) {
    const auto stretch = [&](const Vec3& p) { low = low.cwiseMin(p), high = high.cwiseMax(p); };
    for (const Frame& frame : frames) {
      for (const Index node : nodes) stretch(frame.position[at(node)]);
      for (const Vec3& center : frame.ring_center) stretch(center);
      for (const Vec3& waypoint : frame.joint_waypoint) stretch(waypoint);
    }
    size = std::max(size, (high - low).maxCoeff());
  }
  void pack(const Vec3& p, Bytes& into) const {
    for (int axis = 0; axis < 3; ++axis) into.u16(std::lround((p[axis] - low[axis]) / size * kSteps));
  }
};

// Net 0, closing and other threads 1, towing threads 2.
int family(const ResultModel& model, Index element) {
  const std::string& kind = model.parts[static_cast<std::size_t>(model.element_part[at(element)])].kind;
  return kind == "net" ? 0 : kind == "mechanism" ? 2 : 1;
}

void add_elements(const ResultModel& model, const Shown& shown, Json& json) {
  Bytes ends, families;
  for (const Index e : shown.elements) {
    for (const Index node : model.elements[at(e)]) ends.u16(shown.number[at(node)]);
    families.u8(family(model, e));
  }
  json["segments"] = ends.text();
  json["families"] = families.text();
  json["thinned"] = shown.elements.size() < model.elements.size();
}

// Where threads go through rings, for elements that are shown: [element among those shown, place].
void add_waypoints(const std::vector<Frame>& frames, const Shown& shown, Json& json) {
  constexpr long nowhere = 65535;
  std::unordered_map<Index, long> number;
  for (std::size_t i = 0; i < shown.elements.size(); ++i) number[shown.elements[i]] = static_cast<long>(i);
  Bytes waypoints;
  for (const Frame& frame : frames)
    for (std::size_t j = 0; j < frame.joint_element.size(); ++j) {
      const auto found = number.find(frame.joint_element[j]);
      waypoints.u16(found == number.end() ? nowhere : found->second);
      shown.pack(frame.joint_waypoint[j], waypoints);
    }
  json["waypoints"] = waypoints.text();
}

void add_frames(const std::vector<Frame>& frames, const Shown& shown, Json& json) {
  Bytes positions, levels, rings;
  std::vector<double> greatest;
  for (const Frame& frame : frames)
    greatest.push_back(frame.tension.empty() ? 0
                                             : *std::max_element(frame.tension.begin(), frame.tension.end()));
  const double reference = tension_reference(greatest);
  json["times"] = Json::array();
  for (const Frame& frame : frames) {
    json["times"].push_back(frame.time);
    for (const Index node : shown.nodes) shown.pack(frame.position[at(node)], positions);
    for (const Index e : shown.elements)
      levels.u8(frame.active[at(e)] ? 1 + tension_level(frame.tension[at(e)], reference) : 0);
    for (std::size_t r = 0; r < frame.ring_center.size(); ++r) {
      shown.pack(frame.ring_center[r], rings);
      for (int axis = 0; axis < 3; ++axis)
        rings.u16(std::lround((1 + frame.ring_normal[r][axis]) / 2 * kSteps));
    }
  }
  json["positions"] = positions.text();
  json["levels"] = levels.text();
  json["rings"] = rings.text();
}

void add_bodies(const ResultModel& model, const Shown& shown, Json& json) {
  json["ringSizes"] = Json::array();
  for (const auto& ring : model.rings) json["ringSizes"].push_back({ring.radius, ring.wire_radius});
  json["balls"] = Json::array();
  for (const auto& ball : model.balls)
    json["balls"].push_back({{"center", numbers(ball.center)}, {"radius", ball.radius}});
  json["masses"] = Json::array();
  for (const auto& mass : model.masses) {
    const std::string last = mass.name.substr(mass.name.rfind('.') + 1);
    const bool split = last == "a" || last == "b";
    json["masses"].push_back({{"node", shown.number[at(mass.node)]},
                              {"kind", last == "launcher" ? "launcher"
                                       : split            ? "split"
                                                          : "other"},
                              {"from", split ? model.closing_time.value_or(0) : -1.0}});
  }
}

}  // namespace

std::string net_view_json(const Result& result, const ResultModel& model, const Camera& camera) {
  if (result.frames() == 0) return "";
  Shown shown(model, result.frame(0));
  if (shown.nodes.size() > kMostNodes) return "";
  std::vector<Frame> frames;
  for (const int k : chosen_frames(result.frames(), shown.bytes_of_a_frame(model))) {
    frames.push_back(result.frame(k));
    frames.back().velocity.clear();  // not shown
    frames.back().contact_force.clear();
    frames.back().strain.clear();
  }
  shown.fit(frames);
  Json json{
      {"nodes", shown.nodes.size()}, {"low", numbers(shown.low)}, {"size", shown.size}, {"steps", kSteps}};
  json["high"] = numbers(shown.high);
  json["toward"] = numbers(camera.toward);
  json["up"] = numbers(camera.up);
  add_elements(model, shown, json);
  add_frames(frames, shown, json);
  add_waypoints(frames, shown, json);
  add_bodies(model, shown, json);
  return json.dump();
}

}  // namespace cinch
