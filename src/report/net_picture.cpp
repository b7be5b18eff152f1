#include "report/net_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <numbers>

#include "report/html.hpp"

namespace cinch {
namespace {

constexpr double kMargin = 26;                // px around the scene
constexpr double kSmallestStep = 0.8;         // px: nearer vertices are left out
constexpr std::size_t kMostElements = 24000;  // in one picture

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

std::string px(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.1f", value);
  std::string out = text;
  if (out.size() > 2 && out.compare(out.size() - 2, 2, ".0") == 0) out.resize(out.size() - 2);
  return out == "-0" ? "0" : out;
}

struct Window {
  double left = 1e300, right = -1e300, low = 1e300, high = -1e300;
  void add(const Seen& p, double radius = 0) {
    left = std::min(left, p.x - radius);
    right = std::max(right, p.x + radius);
    low = std::min(low, p.y - radius);
    high = std::max(high, p.y + radius);
  }
};

Window window_of(const ResultModel& model, const Camera& camera, const Frame& frame) {
  Window window;
  const auto present = present_nodes(model, frame);
  for (std::size_t i = 0; i < present.size(); ++i)
    if (present[i]) window.add(camera.see(frame.position[i]));
  for (const Vec3& center : frame.ring_center) window.add(camera.see(center));
  for (const auto& ball : model.balls) {
    const Seen seen = camera.see(ball.center);
    window.add(seen, ball.radius * seen.size);
  }
  return window;
}

/// Draws one frame.
class Painter {
 public:
  Painter(const PictureSet& set, const Frame& frame) : set_(set), frame_(frame), model_(*set.model) {
    const Window window = window_of(model_, set.camera, frame);
    middle_x_ = (window.left + window.right) / 2;
    middle_y_ = (window.low + window.high) / 2;
    for (const auto& ball : model_.balls) balls_.push_back(set.camera.see(ball.center));
  }

  std::string picture(const std::string& label, const std::string& id) {
    draw_chains();
    std::string svg = "<svg class=\"net\" role=\"img\" aria-label=\"" + escape_markup("net at " + label) +
                      "\" viewBox=\"0 0 " + px(set_.width) + " " + px(set_.height) + "\">";
    svg += paths(true) + balls(id) + paths(false) + rings() + masses() + triad();
    return svg + "<text class=\"time\" x=\"14\" y=\"26\">" + escape_markup(label) + "</text></svg>\n";
  }

 private:
  using Point = std::array<double, 2>;

  Point place(const Seen& seen) const {
    return {set_.width / 2 + (seen.x - middle_x_) * set_.pixels_per_metre,
            set_.height / 2 - (seen.y - middle_y_) * set_.pixels_per_metre};
  }

  // Hidden by a ball: inside its disc and farther away than its surface there.
  bool hidden(const Seen& p) const {
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      const double radius = model_.balls[i].radius, across = std::hypot(p.x - balls_[i].x, p.y - balls_[i].y);
      if (across >= radius * balls_[i].size) continue;
      if (p.depth < balls_[i].depth + std::sqrt(std::max(0.0, radius * radius - across * across)) - 1e-9)
        return true;
    }
    return false;
  }

  char family(int part) const {
    const std::string& kind = model_.parts[static_cast<std::size_t>(part)].kind;
    return kind == "net" ? 'n' : kind == "mechanism" ? 't' : 'c';
  }

  // A straight piece of an element.
  struct Stroke {
    std::size_t element;
    Vec3 to;
  };

  // Of a chain from its first node on, through the rings that slide on its elements.
  std::vector<Stroke> strokes(const Chain& chain) const {
    std::vector<Stroke> all;
    for (std::size_t k = 0; k < chain.elements.size(); ++k) {
      const std::size_t e = at(chain.elements[k]);
      const bool forward = model_.elements[e][0] == chain.nodes[k];
      const auto through = waypoints_in(frame_, chain.elements[k]);
      for (std::size_t i = 0; i < through.size(); ++i)
        all.push_back({e, through[forward ? i : through.size() - 1 - i]});
      all.push_back({e, frame_.position[at(chain.nodes[k + 1])]});
    }
    return all;
  }

  void draw_chains() {
    for (const Chain& chain : set_.chains) {
      std::string* path = nullptr;  // the path that the pen is on
      Point last{};
      Seen from = set_.camera.see(frame_.position[at(chain.nodes[0])]);
      const std::vector<Stroke> all = strokes(chain);
      for (const Stroke& stroke : all) {
        const Seen to = set_.camera.see(stroke.to);
        const std::size_t e = stroke.element;
        std::string* wanted = frame_.active[e] ? &line_path(chain.part, e, from, to) : nullptr;
        const Point a = place(from), b = place(to);
        if (wanted != path) {
          if (path && a != last) line_to(*path, a);
          if (wanted) *wanted += "M" + px(a[0]) + " " + px(a[1]), last = a;
          path = wanted;
        }
        const bool end = &stroke == &all.back();
        if (path && (end || std::hypot(b[0] - last[0], b[1] - last[1]) >= kSmallestStep))
          line_to(*path, b), last = b;
        from = to;
      }
    }
  }

  std::string& line_path(int part, std::size_t element, const Seen& from, const Seen& to) {
    const Seen middle{(from.x + to.x) / 2, (from.y + to.y) / 2, (from.depth + to.depth) / 2, 1};
    const std::string look{family(part), static_cast<char>('0' + tension_level(frame_.tension[element],
                                                                               set_.tension_reference))};
    return paths_[{hidden(middle), look}];
  }

  static void line_to(std::string& path, const Point& p) { path += "L" + px(p[0]) + " " + px(p[1]); }

  std::string paths(bool behind) const {
    std::string svg;
    for (const char kind : {'n', 't', 'c'})
      for (const char level : {'0', '1', '2', '3'}) {
        const std::string look{kind, level};
        const auto found = paths_.find({behind, look});
        if (found != paths_.end()) svg += "<path class=\"" + look + "\" d=\"" + found->second + "\"/>";
      }
    return svg;
  }

  std::string balls(const std::string& id) const {
    if (balls_.empty()) return "";
    std::string svg =
        "<defs><radialGradient id=\"" + id +
        "\" cx=\".38\" cy=\".32\" r=\".75\"><stop class=\"b1\" offset=\"0\"/>"
        "<stop class=\"b2\" offset=\".55\"/><stop class=\"b3\" offset=\"1\"/></radialGradient></defs>";
    for (std::size_t i = 0; i < balls_.size(); ++i) {
      const Point p = place(balls_[i]);
      svg += "<circle class=\"b\" cx=\"" + px(p[0]) + "\" cy=\"" + px(p[1]) + "\" r=\"" +
             px(model_.balls[i].radius * balls_[i].size * set_.pixels_per_metre) + "\" fill=\"url(#" + id +
             ")\"/>";
    }
    return svg;
  }

  // A circle seen aslant: an ellipse whose short axis lies along the normal's image. Small rings are drawn
  // larger.
  std::string rings() const {
    std::string svg;
    for (std::size_t r = 0; r < frame_.ring_center.size(); ++r) {
      const Seen seen = set_.camera.see(frame_.ring_center[r]);
      const Point p = place(seen);
      const Vec3& n = frame_.ring_normal[r];
      const double angle =
          std::atan2(-n.dot(set_.camera.up), n.dot(set_.camera.right)) * 180 / std::numbers::pi;
      const double least = frame_.ring_center.size() > 100 ? 1.2 : 4.0;
      const double radius = std::max(least, model_.rings[r].radius * seen.size * set_.pixels_per_metre);
      const double narrow = std::max(0.18, std::abs(n.dot(set_.camera.toward))) * radius;
      svg += std::string("<ellipse class=\"") + (hidden(seen) ? "r far" : "r") + "\" rx=\"" + px(narrow) +
             "\" ry=\"" + px(radius) + "\" transform=\"translate(" + px(p[0]) + " " + px(p[1]) + ") rotate(" +
             px(angle) + ")\"/>";
    }
    return svg;
  }

  std::string masses() const {
    std::string svg;
    const auto present = present_nodes(model_, frame_);
    for (const auto& mass : model_.masses) {
      if (!present[at(mass.node)]) continue;
      const Seen seen = set_.camera.see(frame_.position[at(mass.node)]);
      const Point p = place(seen);
      const auto dot = mass.name.rfind('.');
      const std::string last = dot == std::string::npos ? mass.name : mass.name.substr(dot + 1);
      const bool split = last == "a" || last == "b";
      const char* look = last == "launcher" ? "ml" : split ? "ms" : "mo";
      svg += std::string("<circle class=\"") + look + (hidden(seen) ? " far" : "") + "\" cx=\"" + px(p[0]) +
             "\" cy=\"" + px(p[1]) + "\" r=\"" + px(5.5 * std::clamp(seen.size, 0.7, 1.4)) + "\"><title>" +
             escape_markup(mass.name) + "</title></circle>";
    }
    return svg;
  }

  std::string triad() const {
    const double x0 = 42, y0 = set_.height - 40, length = 28;
    std::string svg = "<g class=\"axes\">";
    for (int axis = 0; axis < 3; ++axis) {
      const Vec3 unit = Vec3::Unit(axis);
      const double x = unit.dot(set_.camera.right), y = -unit.dot(set_.camera.up);
      svg += "<path d=\"M" + px(x0) + " " + px(y0) + "L" + px(x0 + length * x) + " " + px(y0 + length * y) +
             "\"/>";
      const double reach = std::hypot(x, y) > 0.2 ? length + 10 / std::hypot(x, y) : length + 20;
      svg += "<text x=\"" + px(x0 + reach * x) + "\" y=\"" + px(y0 + reach * y + 4) + "\">" + "XYZ"[axis] +
             "</text>";
    }
    return svg + "</g>";
  }

  const PictureSet& set_;
  const Frame& frame_;
  const ResultModel& model_;
  double middle_x_ = 0, middle_y_ = 0;
  std::vector<Seen> balls_;
  std::map<std::pair<bool, std::string>, std::string> paths_;  // hidden?, class -> path data
};

}  // namespace

PictureSet picture_set(const ResultModel& model, const std::vector<Frame>& frames, const ViewHints& hints) {
  PictureSet set;
  set.model = &model;
  set.chains = chosen_chains(element_chains(model, frames.front().position), kMostElements);
  set.camera = choose_camera(model, frames.front(), frames.back(), hints);
  double width = 1e-6, height = 1e-6;
  std::vector<double> tensions;
  for (const Frame& frame : frames) {
    const Window window = window_of(model, set.camera, frame);
    width = std::max(width, window.right - window.left);
    height = std::max(height, window.high - window.low);
    tensions.push_back(frame.tension.empty() ? 0
                                             : *std::max_element(frame.tension.begin(), frame.tension.end()));
  }
  set.tension_reference = tension_reference(tensions);
  set.height = std::clamp(set.width * height / width, 0.5 * set.width, 0.9 * set.width);
  set.pixels_per_metre = std::min((set.width - 2 * kMargin) / width, (set.height - 2 * kMargin) / height);
  return set;
}

void PictureSet::take_view_of(const PictureSet& other) {
  camera = other.camera;
  pixels_per_metre = other.pixels_per_metre;
  width = other.width;
  height = other.height;
  tension_reference = other.tension_reference;
}

std::string net_picture(const PictureSet& set, const Frame& frame, const std::string& label,
                        const std::string& id) {
  return Painter(set, frame).picture(label, id);
}

}  // namespace cinch
