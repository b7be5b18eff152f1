#include "plan/piece.hpp"

#include <algorithm>
#include <utility>

#include "store/fields.hpp"

namespace cinch {
namespace {

constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

constexpr int sweep_levels = 4;         ///< steps in one sweep over a scene too large for the cache
constexpr Index nodes_in_cache = 8000;  ///< 56 bytes each: half of a second-level cache

// The first block whose nodes all lie behind what the elements of block b reach, less b; at most.
std::size_t reach_in_blocks(const std::vector<Index>& edges, Index reach) {
  std::size_t most = 1;
  for (std::size_t b = 0; b + 1 < edges.size(); ++b) {
    std::size_t next = b + 1;
    while (next + 1 < edges.size() && edges[next] < edges[b + 1] + reach) ++next;
    most = std::max(most, next - b);
  }
  return most;
}

}  // namespace

Piece::Piece(const Model& model, const StepPlan& plan, const std::vector<double>& node_share)
    : plan_(plan), whole_(true), numbering_(Numbering::all(model.nodes)), topology_(model.topology) {
  set_up(model, node_share);
  joints_.take_all(model);
}

Piece::Piece(const Model& model, const StepPlan& plan, const std::vector<double>& node_share,
             const std::vector<Index>& own, int depth)
    : plan_(plan),
      whole_(false),
      numbering_(Numbering::of(own, model.topology, model.nodes, depth)),
      topology_(local_topology(model.topology, numbering_)) {
  set_up(model, node_share);
}

void Piece::set_up(const Model& model, const std::vector<double>& node_share) {
  choose_kernels();
  set_constraints(model);
  reduction_ = reduce_forces(topology_, numbering_, constraints_);
  set_parameters(model);
  if (plan_.contacts()) levels_ = 1;
  else levels_ = whole_ ? (model.nodes > nodes_in_cache ? sweep_levels : 1) : numbering_.depth;
  Index reach = 0;
  for (const Run& run : topology_.runs) reach = std::max(reach, run.offset);
  for (const LinkEnds& link : topology_.links) reach = std::max(reach, link.b - link.a);
  lag_ = reach_in_blocks(reduction_.edges, reach);
  allocate(model, node_share);
}

Piece::ElementKernels Piece::element_kernels(kernel::Book::Sum book) const {
  return {kernels_.axial_spans[plan_.damped][book], kernels_.axial_links[plan_.damped][book]};
}

void Piece::choose_kernels() {
  const bool power = step_book() == kernel::Book::power;
  const kernel::Moving::Kind kind = plan_.joints       ? kernel::Moving::loaded
                                    : plan_.contacts() ? kernel::Moving::watched
                                                       : kernel::Moving::blind;
  step_ = {element_kernels(step_book()), kernels_.update_chain[plan_.damped][power][plan_.gravity][kind],
           kernels_.move_nodes[plan_.gravity][kind]};
}

void Piece::set_constraints(const Model& model) {
  for (std::size_t c = 0; c < model.constraints.size(); ++c) {
    kernel::Constraint here = model.constraints[c];
    here.node = numbering_.local(here.node);
    if (here.node < 0 || !numbering_.moved(here.node)) continue;
    constraints_.push_back(here);
    reaction_number_.push_back(numbering_.own(here.node) ? static_cast<Index>(c) : -1);
  }
  held_.resize(constraints_.size());
  reactions_.resize(constraints_.size());
}

void Piece::set_parameters(const Model& model) {
  palette_ = make_palette(model, topology_, plan_.dt);
  for (std::size_t i = 0; i < topology_.links.size(); ++i) {
    const auto e = at(topology_.links[i].element);
    kernel::Link& link = reduction_.links[i];
    link.stiffness = model.stiffness[e], link.damping = model.damping[e];
    link.rest_length = model.rest_length[e], link.give = element_give(model, e, plan_.dt);
  }
}

void Piece::allocate(const Model& model, const std::vector<double>& node_share) {
  const auto nodes = at(numbering_.nodes());
  scale_.assign(nodes, 0.0);
  for (std::size_t i = 0; i < nodes; ++i)
    if (numbering_.moved(static_cast<Index>(i))) scale_[i] = plan_.dt / model.mass[at(numbering_.global[i])];
  for (auto& f : force_) f.assign(at(reduction_.force_count) * at(levels_), 0.0);
  ledger_size_ = at(model.ledger_rows() * kernel::lanes);
  if (step_book() == kernel::Book::power) {
    damper_.assign(palette_.of_group.size() * kernel::lanes, 0.0);
    link_damper_.assign(reduction_.links.size(), 0.0);
    if (!whole_) make_own_ledger();
  }
  set_contact_ghosts({}, node_share);
}

// Shares are whole grains: the first node of one tells whose row it is.
void Piece::make_own_ledger() {
  ledger_.assign(ledger_size_, 0.0);
  for (Index i = 0; i < numbering_.nodes(); ++i)
    if (numbering_.own(i) && numbering_.global[at(i)] % kernel::grain == 0)
      own_rows_.push_back(numbering_.global[at(i)] / kernel::grain);
}

void Piece::set_contact_ghosts(std::vector<Index> nodes, const std::vector<double>& node_share) {
  contact_ghosts_ = std::move(nodes);
  const std::size_t numbered = at(numbering_.nodes()), all = numbered + contact_ghosts_.size();
  scale_.resize(all, 0.0);
  std::fill(scale_.begin() + numbering_.nodes(), scale_.end(), 0.0);
  if (plan_.contacts()) {
    share_.resize(all);
    for (std::size_t i = 0; i < all; ++i) {
      const Index node = i < numbered ? numbering_.global[i] : contact_ghosts_[i - numbered];
      share_[i] = node >= 0 ? node_share[at(node)] : 0.0;
    }
  }
  if (!whole_)
    for (auto& field : own_fields_) field.resize(all, 0.0);
}

Index Piece::local(Index global_node) const {
  if (whole_) return global_node;
  if (const Index numbered = numbering_.local(global_node); numbered >= 0) return numbered;
  const auto found = std::lower_bound(contact_ghosts_.begin(), contact_ghosts_.end(), global_node);
  if (found == contact_ghosts_.end() || *found != global_node) return -1;
  return numbering_.nodes() + static_cast<Index>(found - contact_ghosts_.begin());
}

std::vector<Index> Piece::ghost_places() const {
  std::vector<Index> places;
  for (Index i = 0; i < numbering_.nodes(); ++i)
    if (numbering_.ghost(i)) places.push_back(i);
  for (std::size_t i = 0; i < contact_ghosts_.size(); ++i)
    places.push_back(numbering_.nodes() + static_cast<Index>(i));
  return places;
}

std::vector<Index> Piece::ghosts() const {
  std::vector<Index> nodes;
  for (const Index place : ghost_places())
    nodes.push_back(place < numbering_.nodes() ? numbering_.global[at(place)]
                                               : contact_ghosts_[at(place - numbering_.nodes())]);
  return nodes;
}

std::vector<bool> Piece::moved_by_speed() const {
  std::vector<bool> moved(scale_.size(), levels_ == 1);
  for (const kernel::Kick& kick : reduction_.kicks) moved[at(kick.node)] = false;
  for (const auto& nodes : {contacts_.nodes(), joints_.nodes_needed()})
    for (const Index node : nodes) moved[at(node)] = false;
  return moved;
}

void Piece::take(State& state) {
  for (std::size_t f = 0; f < 6; ++f) {
    AlignedVector<double>& from = state.*node_fields[f].values;
    if (whole_) {
      fields_[f] = from.data();
      continue;
    }
    fields_[f] = own_fields_[f].data();
    for (std::size_t i = 0; i < numbering_.global.size(); ++i)
      if (numbering_.global[i] >= 0) fields_[f][i] = from[at(numbering_.global[i])];
    for (std::size_t i = 0; i < contact_ghosts_.size(); ++i)
      fields_[f][numbering_.global.size() + i] = from[at(contact_ghosts_[i])];
  }
  if (plan_.joints) joints_.take(state, scale_.size());
  contacts_.take();
  copy_rows(state.dissipated, ledger_);
  bind(state);
  if (step_book() == kernel::Book::power && !knows_dampers_) find_dampers();
}

// Steps book what dampers take between the step before and this one. There is none before the first: with
// dampers that pulled the other way then, it books next to nothing (a scene's first velocities are those of
// t = 0 here, and half a step earlier there).
void Piece::find_dampers() {
  AlignedVector<double> nowhere(ledger_size_, 0.0);
  double* const booked = std::exchange(axial_.booked, nowhere.data());
  for (const Block& block : reduction_.blocks)
    compute(block, block.span_end, element_kernels(kernel::Book::power));
  for (auto* forces : {&damper_, &link_damper_})
    for (double& force : *forces) force = 0 - force;  // no negative zeros
  axial_.booked = booked;
  knows_dampers_ = true;
}

// Calls visit(user's element, its lower node here, group x lanes) for those of runs.
template <class Visit>
void Piece::for_each_element(Visit&& visit) const {
  std::size_t place = 0;
  for (const Run& run : topology_.runs)
    for (Index node = first_group_node(run), end = node + group_count(run) * kernel::lanes; node < end;
         ++node, ++place) {
      const Index k = node - run.a;
      const Index e = k >= 0 && k < run.count ? topology_.slot_element[at(run.slot + k)] : -1;
      if (e >= 0) visit(at(e), node, place);
    }
}

bool Piece::tell_dampers(AlignedVector<double>& forces) const {
  if (!knows_dampers_) return false;
  for_each_element([&](std::size_t e, Index node, std::size_t place) {
    if (numbering_.own(node)) forces[e] = damper_[place];
  });
  for (std::size_t i = 0; i < link_damper_.size(); ++i)
    if (reduction_.links[i].row >= 0) forces[at(topology_.links[i].element)] = link_damper_[i];
  return true;
}

void Piece::set_dampers(const AlignedVector<double>& forces) {
  // those of others are never renewed here
  for_each_element([&](std::size_t e, Index node, std::size_t place) {
    if (numbering_.own(node)) damper_[place] = forces[e];
  });
  for (std::size_t i = 0; i < link_damper_.size(); ++i)
    if (reduction_.links[i].row >= 0) link_damper_[i] = forces[at(topology_.links[i].element)];
  knows_dampers_ = true;
}

// Those that it books; none of a whole piece, which books into the state itself.
void Piece::copy_rows(const AlignedVector<double>& from, AlignedVector<double>& to) const {
  for (const Index row : own_rows_) {
    const auto first = from.begin() + row * kernel::lanes;
    std::copy(first, first + kernel::lanes, to.begin() + row * kernel::lanes);
  }
}

void Piece::give(State& state) const {
  joints_.give(state);
  contacts_.give();
  if (whole_) return;
  copy_rows(ledger_, state.dissipated);
  for (std::size_t f = 0; f < 6; ++f) {
    AlignedVector<double>& to = state.*node_fields[f].values;
    for (std::size_t i = 0; i < numbering_.global.size(); ++i)
      if (numbering_.layer[i] == 0) to[at(numbering_.global[i])] = fields_[f][i];
  }
}

void Piece::bind(State& state) {
  axial_ = {fields_[0],
            fields_[1],
            fields_[2],
            fields_[3],
            fields_[4],
            fields_[5],
            palette_.of_group.data(),
            palette_.rows.data(),
            force_[0].data(),
            force_[1].data(),
            force_[2].data(),
            whole_ ? state.dissipated.data() : ledger_.data(),
            damper_.data(),
            link_damper_.data(),
            nullptr,
            plan_.dt};
  const Vec3 g = plan_.dt * plan_.gravity_acceleration;
  node_ = {fields_[0],
           fields_[1],
           fields_[2],
           fields_[3],
           fields_[4],
           fields_[5],
           scale_.data(),
           force_[0].data(),
           force_[1].data(),
           force_[2].data(),
           {g.x(), g.y(), g.z()},
           plan_.dt,
           joints_.standing(0),
           joints_.standing(1),
           joints_.standing(2)};
  for (std::size_t c = 0; c < reactions_.size(); ++c)
    reactions_[c] = reaction_number_[c] >= 0 ? &state.reactions[at(reaction_number_[c])] : &unbooked_;
}

NodeView Piece::view() const {
  return {fields_[0], fields_[1], fields_[2], fields_[3], fields_[4], fields_[5], share_.data()};
}

void Piece::use_level(int level) {
  const std::size_t first = at(level) * at(reduction_.force_count);
  axial_.fx = force_[0].data() + first, axial_.fy = force_[1].data() + first,
  axial_.fz = force_[2].data() + first;
  node_.fx = axial_.fx, node_.fy = axial_.fy, node_.fz = axial_.fz;
}

kernel::Book::Sum Piece::step_book() const {
  return plan_.damped && plan_.ledger ? kernel::Book::power : kernel::Book::nothing;
}

// Forces of the block's elements: links, and spans up to span_end. Those between neighbours come after the
// links, for the sums of the ledger.
inline void Piece::compute(const Block& b, Index span_end, const ElementKernels& elements) {
  const ForceReduction& r = reduction_;
  if (b.patch_begin < b.patch_end)
    kernels_.patch_forces(axial_, r.patches.data(), b.patch_begin, b.patch_end);
  if (b.link_begin == b.link_end) {
    if (b.span_begin < span_end) elements.spans(axial_, r.spans.data(), b.span_begin, span_end);
    return;
  }
  elements.spans(axial_, r.spans.data(), b.span_begin, b.neighbour_begin);
  elements.links(axial_, r.links.data(), b.link_begin, b.link_end);
  elements.spans(axial_, r.spans.data(), b.neighbour_begin, span_end);
}

// Those between neighbours, in ascending order, where chains are moved in the pass that computes them.
double Piece::update_neighbours(const Block& b) {
  const ForceReduction& r = reduction_;
  double greatest = 0;
  for (Index i = b.neighbour_begin; i < b.span_end; ++i) {
    const kernel::Span& span = r.spans[at(i)];
    if (span.stretch < 0) step_.elements.spans(axial_, r.spans.data(), i, i + 1);
    else
      greatest = std::max(greatest, step_.update_chain(axial_, node_, span, r.stretches[at(span.stretch)]));
  }
  return greatest;
}

// What supports do comes later.
inline double Piece::move(const Block& b, Index stretch_begin, MoveNodes move_nodes) {
  const ForceReduction& r = reduction_;
  const double greatest = move_nodes(node_, r.stretches.data(), stretch_begin, b.stretch_end);
  if (b.kick_begin == b.kick_end) return greatest;
  return std::max(greatest, kernels_.kick_nodes(node_, r.kicks.data(), b.kick_begin, b.kick_end));
}

double Piece::compute_and_move(const Block& b, StageClock& clock) {
  const bool one_pass = step_.update_chain != nullptr;  // moves chains as it computes them
  compute(b, one_pass ? b.neighbour_begin : b.span_end, step_.elements);
  const double chains = one_pass ? update_neighbours(b) : 0;
  clock.tick(StageId::axial_forces);
  const double greatest = move(b, one_pass ? b.chain_stretch_end : b.stretch_begin, step_.move_nodes);
  clock.tick(StageId::gather_and_move);
  return std::max(chains, greatest);
}

void Piece::hold_before(Index begin, Index end) {
  if (begin < end) kernels_.hold_before(node_, constraints_.data(), begin, end, held_.data());
}

void Piece::hold_after(Index begin, Index end) {
  if (begin < end)
    kernels_.hold_after(node_, constraints_.data(), begin, end, held_.data(), reactions_.data());
}

double Piece::load_nodes(std::span<const kernel::Load> loads) {
  return kernels_.load_nodes(node_, loads.data(), static_cast<Index>(loads.size()));
}

double Piece::step(std::int64_t number, double motion, StageClock& clock) {
  const double time = plan_.timeline.time_of(number);
  const auto constraints = static_cast<Index>(constraints_.size());
  if (plan_.touches()) contacts_.evaluate(view(), plan_, time, plan_.dt, motion);
  if (plan_.joints) {
    if (plan_.joints_hold(number) == 0) joints_.evaluate(view(), plan_, number);
    joints_.push(view(), plan_, motion);
  }
  clock.tick(StageId::contacts);
  hold_before(0, constraints);
  double greatest = 0;
  for (const Block& block : reduction_.blocks) greatest = std::max(greatest, compute_and_move(block, clock));
  greatest = std::max(greatest, load_nodes(contacts_.loads()));
  if (plan_.joints) greatest = std::max(greatest, load_nodes(joints_.pushing()));
  hold_after(0, constraints);
  clock.tick(StageId::gather_and_move);
  return greatest;
}

// Step s works `lag_` blocks behind step s - 1: what it needs has had that step then, and a few blocks go
// through all steps while they are in the cache.
void Piece::sweep(int steps, StageClock& clock) {
  const auto step_block = [&](const Block& block) {
    hold_before(block.constraint_begin, block.constraint_end);
    compute_and_move(block, clock);
    hold_after(block.constraint_begin, block.constraint_end);
  };
  if (steps == 1) {
    for (const Block& block : reduction_.blocks) step_block(block);
    return;
  }
  const std::size_t blocks = reduction_.blocks.size(), delay = at(steps - 1) * lag_;
  for (std::size_t front = 0; front < blocks + delay; ++front)
    for (int s = 0; s < steps; ++s) {
      const std::size_t behind = at(s) * lag_;
      if (front < behind) break;
      if (front - behind >= blocks) continue;
      use_level(s);
      step_block(reduction_.blocks[front - behind]);
    }
}

double Piece::time_to_pull(double spare, double enough) const {
  const auto works = [](double force) { return force != 0; };  // the next step books its power
  for (const auto* dampers : {&damper_, &link_damper_})
    if (std::any_of(dampers->begin(), dampers->end(), works)) return 0;
  const ForceReduction& r = reduction_;
  return kernels_.time_to_pull(axial_, r.spans.data(), static_cast<Index>(r.spans.size()), r.links.data(),
                               static_cast<Index>(r.links.size()), 1 - spare, enough);
}

void Piece::fly(Index steps) { kernels_.fly_freely[plan_.gravity](node_, numbering_.nodes(), steps); }

// From now on, nodes of `out` move in place of this piece's; those of a piece that is not whole in its own
// copy.
void Piece::lend(Glance& out) {
  double* moved[6];
  for (std::size_t f = 0; f < 6; ++f) {
    const bool gain = f >= 3;
    AlignedVector<double>& field = whole_ && gain ? out.gain[f - 3] : glance_fields_[f];
    if (gain) field.assign(scale_.size(), 0.0);
    else field.resize(scale_.size(), 0.0);  // its values mean nothing
    moved[f] = field.data();
  }
  node_.x = moved[0], node_.y = moved[1], node_.z = moved[2];
  node_.vx = moved[3], node_.vy = moved[4], node_.vz = moved[5];
  axial_.booked = out.elastic.data(), axial_.due = out.due.data();
  for (kernel::Reaction*& reaction : reactions_) reaction = &unbooked_;
}

void Piece::glance(State& state, double motion, Glance& out) {
  take(state);
  const double time = plan_.timeline.time_of(state.step);
  if (plan_.touches()) contacts_.evaluate(view(), plan_, time, 0, motion);
  if (plan_.joints) {
    joints_.glance(view(), plan_, state.step);
    joints_.push(view(), plan_, motion);
  }
  lend(out);
  const auto constraints = static_cast<Index>(constraints_.size());
  hold_before(0, constraints);
  const ElementKernels elements =
      element_kernels(out.due.empty() ? kernel::Book::energy : kernel::Book::energy_and_power);
  for (const Block& block : reduction_.blocks) {
    compute(block, block.span_end, elements);
    move(block, block.stretch_begin, kernels_.move_nodes[plan_.gravity][kernel::Moving::blind]);
  }
  load_nodes(contacts_.loads());
  if (plan_.joints)
    for (const auto& loads : {joints_.on_threads(), joints_.on_hosts(), joints_.pushing()}) load_nodes(loads);
  hold_after(0, constraints);
  contacts_.give();  // the look finds them in the state
  for (std::size_t f = 0; !whole_ && f < 3; ++f)
    for (std::size_t i = 0; i < numbering_.global.size(); ++i)
      if (numbering_.layer[i] == 0) out.gain[f][at(numbering_.global[i])] = glance_fields_[3 + f][i];
}

void Piece::tell_joints(State& state) const {
  if (plan_.joints) joints_.tell(state);
}

void Piece::append_loads(std::vector<kernel::Load>& loads) const {
  append(contacts_.loads(), loads);
  append(joints_.on_hosts(), loads);
  append(joints_.pushing(), loads);
}

void Piece::append(std::span<const kernel::Load> list, std::vector<kernel::Load>& loads) const {
  for (kernel::Load load : list) {
    if (load.node >= numbering_.nodes() || !numbering_.own(load.node)) continue;
    load.node = numbering_.global[at(load.node)];
    loads.push_back(load);
  }
}

}  // namespace cinch
