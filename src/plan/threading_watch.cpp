#include "plan/threading_watch.hpp"

#include <limits>

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr std::int64_t interval = 2000;  ///< steps: looks would cost a closing scene 3 % at each 100th

// What one element adds: 1 or -1, if it goes through the disc of the ring.
Index passage(const Look& now, const Part& thread, Index element, const Vec3& center, const Vec3& normal,
              double radius) {
  const std::size_t k = at(element - thread.first_element);
  const Vec3 a = now.position(thread.nodes[k]) - center, b = now.position(thread.nodes[k + 1]) - center;
  const double axial_a = normal.dot(a), axial_b = normal.dot(b);
  if ((axial_a < 0) == (axial_b < 0)) return 0;
  const double t = axial_a / (axial_a - axial_b);
  if (!(((1 - t) * a + t * b).norm() < radius)) return 0;
  return axial_a < 0 ? 1 : -1;
}

Index times_through(const Look& now, const ContactList& contacts, Index ring, const Part& thread) {
  const Vec3 center = now.ring_center(ring), normal = now.ring_normal(ring);
  const double radius = now.assembly().rings[at(ring)].radius;
  Index times = 0;
  for (Index i = contacts.ring_begin[at(ring)]; i < contacts.ring_begin[at(ring) + 1]; ++i) {
    const Index e = contacts.pairs[at(i)].element;
    if (e >= thread.first_element && e < thread.first_element + thread.elements)
      times += passage(now, thread, e, center, normal, radius);
  }
  return times;
}

}  // namespace

void ThreadingWatch::begin(const Look& now, const ContactList& contacts) {
  const Assembly& assembly = now.assembly();
  const Index rings = static_cast<Index>(now.model().rings.size());  // none where none can touch
  for (Index r = 0; r < rings; ++r)
    for (const Index p : assembly.rings[at(r)].parts) {
      const Part& part = assembly.parts[at(p)];
      const bool fresh = now.present(part.first_element) && part.first_element >= elements_;
      if (part.kind != PartKind::thread || !fresh) continue;
      if (const Index times = times_through(now, contacts, r, part); times != 0)
        watched_.push_back({r, p, times});
    }
  elements_ = now.model().elements;
}

std::vector<ThreadingWatch::Loss> ThreadingWatch::losses(const Look& now, const ContactList& contacts) {
  std::vector<Loss> lost;
  if (now.step() < next_) return lost;
  next_ = now.step() + interval;
  std::erase_if(watched_, [&](const Watched& item) {
    const Index times = times_through(now, contacts, item.ring, now.assembly().parts[at(item.part)]);
    if (times == item.times) return false;
    lost.push_back({item.ring, item.part, item.times, times});
    return true;
  });
  return lost;
}

void ThreadingWatch::transfer(Archive& archive, const Assembly& assembly, Index elements) {
  elements_ = elements;
  archive.whole("threadings/next_step", next_, 0, std::numeric_limits<std::int64_t>::max() - interval);
  watched_.resize(archive.length("threadings/ring", watched_.size()));
  archive.column("threadings/ring", watched_, &Watched::ring, 0,
                 static_cast<std::int64_t>(assembly.rings.size()) - 1);
  archive.column("threadings/thread", watched_, &Watched::part, 0,
                 static_cast<std::int64_t>(assembly.parts.size()) - 1);
  archive.column("threadings/times", watched_, &Watched::times, -1000000, 1000000);
}

}  // namespace cinch
