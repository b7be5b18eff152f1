// Keys of threads, nets, rings and closing mechanisms.
#include "input/key_table.hpp"

namespace cinch {

namespace {

using enum KeyType;

constexpr Range coordinate = {-1e6, 1e6, true};
constexpr Range speed = {-1e5, 1e5, true};
constexpr Range count = {1, 1e8, true};
constexpr Range mass = {0, 1e6, true};
constexpr Range body = {1e-12, 1e6, true};  // a mass by itself: its inverse must be a number
constexpr Range thickness = {0, 10, false};
const std::vector<std::string> supports = {"free", "guided", "fixed"};

// Keys that [ring.NAME] and [rings.NAME] share; `get` finds the ring in what the section fills.
template <class Part, class Get>
std::vector<Key<Part>> ring_keys(Get get) {
  const auto to = [get](auto member) {
    return [get, set = into(member)](Part& part, const Value& value) { set(get(part), value); };
  };
  return {
      {{.name = "diameter_m",
        .unit = "m",
        .range = above(0, 1e3),
        .required = true,
        .meaning = "Diameter of the wire's centre line (the paper does not say which diameter it gives)."},
       to(&Ring::diameter)},
      {{.name = "wire_diameter_m",
        .unit = "m",
        .range = thickness,
        .required = true,
        .meaning = "Diameter of the wire."},
       to(&Ring::wire_diameter)},
      {{.name = "mass_kg",
        .unit = "kg",
        .range = body,
        .required = true,
        .meaning = "Mass (Tables 1, 2 and 4 give three different ones)."},
       to(&Ring::mass)},
      {{.name = "youngs_modulus_Pa",
        .unit = "Pa",
        .range = above(0, 1e13),
        .required = true,
        .meaning = "Young's modulus of the wire."},
       to(&Ring::youngs_modulus)},
      {{.name = "poissons_ratio",
        .range = from(-0.99, 0.5),
        .fallback = "0.33",
        .meaning = "Poisson's ratio.",
        .source = "Table 1, ring"},
       to(&Ring::poissons_ratio)},
      {{.name = "threads",
        .type = names,
        .refers = a_thread_name,
        .fallback = "[]",
        .meaning = "Names of the threads it can touch; empty: every thread.",
        .source = "a ring stops whatever meets it"},
       to(&Ring::threads)},
      {{.name = "joint",
        .type = choice,
        .words = {"contact", "sliding", "auto"},
        .fallback = "\"auto\"",
        .by_method = {{"contact", "\"contact\""}, {"paper", "\"contact\""}},
        .meaning =
            "How threads go through it: `contact` with its wire, or `sliding` without friction, the ring "
            "inside an element of the thread (threads that pass through its opening at the start, each once; "
            "far fewer elements and longer steps for the same error). `auto`: sliding where that can be, "
            "with `threads` where it can be for all of them; else contact.",
        .source = "Sec. 4; `sliding` is not in the paper"},
       to(&Ring::joint)},
  };
}

// Keys of a mass that targets feel as a sphere; `get` finds it in what the section fills.
template <class Part, class Get>
std::vector<Key<Part>> sphere_keys(const std::string& prefix, const std::string& what, Get get) {
  const auto to = [get](auto member) {
    return [get, set = into(member)](Part& part, const Value& value) { set(get(part), value); };
  };
  return {
      {{.name = prefix + "radius_m",
        .unit = "m",
        .range = from(0, 1e3),
        .fallback = "0",
        .meaning = "Radius with which " + what +
                   " touches targets, where its part does (`target.NAME.touches`); 0: a point, which "
                   "touches nothing.",
        .source = "the paper does not say whether masses touch the target"},
       to(&Sphere::radius)},
      {{.name = prefix + "youngs_modulus_Pa",
        .unit = "Pa",
        .range = above(0, 1e13),
        .fallback_note = "that of the target",
        .only_with = prefix + "radius_m",
        .meaning = "Young's modulus of that sphere."},
       to(&Sphere::youngs_modulus)},
      {{.name = prefix + "poissons_ratio",
        .range = from(-0.99, 0.5),
        .fallback = "0.3",
        .only_with = prefix + "youngs_modulus_Pa",
        .meaning = "Poisson's ratio of that sphere.",
        .source = "Table 1, thread"},
       to(&Sphere::poissons_ratio)},
  };
}

template <class Part>
std::vector<Key<Part>> joined(std::initializer_list<std::vector<Key<Part>>> lists) {
  std::vector<Key<Part>> all;
  for (const auto& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

}  // namespace

const Section<NodeSpec>& node_section() {
  static const Section<NodeSpec> section(
      {.name = "node",
       .named = true,
       .about = "What hangs on one node: the sub-tables `[thread.NAME.start]`, `[thread.NAME.end]`, "
                "`[thread.NAME.node.K]` (K = 0 .. elements) and `[net.NAME.node.PLACE]` (PLACE: `top_left`, "
                "`top_right`, `bottom_right`, `bottom_left`, or `\"knot.I.J\"` in quotes, column I from the "
                "left and "
                "row J from the bottom, both from 0)."},
      joined<NodeSpec>(
          {std::vector<Key<NodeSpec>>{
               {{.name = "on",
                 .type = name,
                 .refers = any_node,
                 .fallback_note = "a node of its own",
                 .meaning = "Share the node of another part: `mechanism.NAME.launcher`, `.a` or `.b`, "
                            "`net.NAME.PLACE`, "
                            "`thread.NAME.start`, `.end` or `.node.K`, `ring.NAME` (a ring with a node of "
                            "its own)."},
                into(&NodeSpec::on)},
               {{.name = "mass_kg",
                 .unit = "kg",
                 .range = mass,
                 .fallback = "0",
                 .meaning = "Mass added to the threads' share, m_c of eq. (2).",
                 .source = "no mass"},
                into(&NodeSpec::mass)},
               {{.name = "support",
                 .type = choice,
                 .words = supports,
                 .fallback = "\"free\"",
                 .meaning = "`free`, `guided` along `axis`, or `fixed`.",
                 .source = "no support"},
                into(&NodeSpec::support)},
               {{.name = "axis",
                 .type = vector,
                 .nonzero = true,
                 .fallback_note = "none; needed by `guided`",
                 .meaning = "Direction of motion of a guided node (any length)."},
                [](NodeSpec& node, const Value& value) { node.axis = value.vector.normalized(); }},
               {{.name = "velocity_m_s",
                 .type = vector,
                 .unit = "m/s",
                 .range = speed,
                 .fallback_note = "that of its thread or net",
                 .meaning = "Initial velocity."},
                into(&NodeSpec::velocity)},
           },
           sphere_keys<NodeSpec>("", "the mass", [](NodeSpec& node) -> Sphere& { return node.sphere; })}));
  return section;
}

const Section<Thread>& thread_section() {
  static const Section<Thread> section(
      {.name = "thread",
       .named = true,
       .about = "A thread, laid along `points_m`, or as a closing thread `along` other parts from the "
                "closing time "
                "on."},
      {
          {{.name = "material",
            .type = name,
            .refers = a_material_name,
            .required = true,
            .meaning = "Name of a `[material.NAME]`."},
           into(&Thread::material)},
          {{.name = "diameter_m", .unit = "m", .range = thickness, .required = true, .meaning = "Diameter."},
           into(&Thread::diameter)},
          {{.name = "elements",
            .type = whole,
            .range = count,
            .fallback = "12",
            .by_method = {{"contact", "200"}, {"paper", "200"}},
            .meaning = "Number of elements.",
            .source = "about 1 % of error with sliding joints (bench/study); the paper's 200 a metre with contact. "
                      "`cinch check --error` tells what a case needs"},
           into(&Thread::elements)},
          {{.name = "points_m",
            .type = points,
            .unit = "m",
            .range = coordinate,
            .required = true,
            .not_with = "along",
            .meaning = "Corners of the polyline on which it starts, two or more."},
           into(&Thread::points)},
          {{.name = "along",
            .type = names,
            .refers = a_net_edge | a_mechanism,
            .fallback_note = "none",
            .meaning = "Parts it is laid along, in order: `net.NAME.top`, `.right`, `.bottom`, `.left` and "
                       "`mechanism.NAME` (its towing thread)."},
           into(&Thread::along)},
          {{.name = "overhang_start_m",
            .unit = "m",
            .range = from(0, 1e4),
            .fallback = "0",
            .only_with = "along",
            .meaning =
                "Straight continuation before the first part, in the direction that this has at t = 0.",
            .source = "no overhang"},
           into(&Thread::overhang_start)},
          {{.name = "overhang_end_m",
            .unit = "m",
            .range = from(0, 1e4),
            .fallback = "0",
            .only_with = "along",
            .meaning = "Straight continuation behind the last part, in the direction that this has at t = 0.",
            .source = "no overhang"},
           into(&Thread::overhang_end)},
          {{.name = "length_m",
            .unit = "m",
            .range = from(0, 1e6),
            .fallback = "0",
            .meaning = "Unstretched length; 0: as laid.",
            .source = "neither slack nor tension"},
           into(&Thread::length)},
          {{.name = "velocity_m_s",
            .type = vector,
            .unit = "m/s",
            .range = speed,
            .fallback = "[0, 0, 0]",
            .not_with = "along",
            .meaning =
                "Initial velocity of all nodes. Closing threads take over that of the parts below them.",
            .source = "at rest"},
           into(&Thread::velocity)},
          {{.name = "start", .type = node, .meaning = "First node."}},
          {{.name = "end", .type = node, .meaning = "Last node."}},
          {{.name = "node", .type = nodes, .meaning = "Further nodes, by number."}},
      });
  return section;
}

const Section<Net>& net_section() {
  static const Section<Net> section(
      {.name = "net",
       .named = true,
       .about =
           "A rectangular net of square meshes. Its edges run clockwise, seen with `x_axis` to the right and "
           "`y_axis` up: `top` from left to right, `right` downwards, `bottom` from right to left, `left` "
           "upwards."},
      {
          {{.name = "material",
            .type = name,
            .refers = a_material_name,
            .required = true,
            .meaning = "Name of a `[material.NAME]`."},
           into(&Net::material)},
          {{.name = "diameter_m",
            .unit = "m",
            .range = thickness,
            .required = true,
            .meaning = "Diameter of the net's threads."},
           into(&Net::diameter)},
          {{.name = "size_m",
            .type = pair,
            .unit = "m",
            .range = above(0, 1e5),
            .required = true,
            .meaning = "Unstretched width (along `x_axis`) and height (along `y_axis`)."},
           [](Net& net, const Value& value) {
             net.width = value.vector.x();
             net.height = value.vector.y();
           }},
          {{.name = "mesh_m",
            .unit = "m",
            .range = above(0, 1e5),
            .required = true,
            .meaning = "Side of a mesh; a whole number of meshes must fill width and height."},
           into(&Net::mesh)},
          {{.name = "elements_per_side",
            .type = whole,
            .range = {1, 10000, true},
            .fallback = "1",
            .meaning = "Elements of each mesh side.",
            .source = "not in the paper; its rings sit \"at the midpoint of the element\", so 1"},
           into(&Net::elements_per_side)},
          {{.name = "center_m",
            .type = vector,
            .unit = "m",
            .range = coordinate,
            .fallback = "[0, 0, 0]",
            .meaning = "Centre.",
            .source = "Sec. 5.3"},
           into(&Net::center)},
          {{.name = "x_axis",
            .type = vector,
            .nonzero = true,
            .fallback = "[1, 0, 0]",
            .meaning = "Direction of the width (any length).",
            .source = "Sec. 5.3"},
           [](Net& net, const Value& value) { net.x_axis = value.vector.normalized(); }},
          {{.name = "y_axis",
            .type = vector,
            .nonzero = true,
            .fallback = "[0, 1, 0]",
            .meaning = "Direction of the height, at right angles to `x_axis`.",
            .source = "Sec. 5.3"},
           [](Net& net, const Value& value) { net.y_axis = value.vector.normalized(); }},
          {{.name = "stowed_factor",
            .range = above(0, 10),
            .fallback = "1",
            .meaning = "Initial size over unstretched size; a plane net scaled uniformly.",
            .source = "the paper's net is \"stored at the origin\" (Sec. 5.3); the shape is not given"},
           into(&Net::stowed_factor)},
          {{.name = "velocity_m_s",
            .type = vector,
            .unit = "m/s",
            .range = speed,
            .fallback = "[0, 0, 0]",
            .meaning = "Initial velocity of all nodes.",
            .source = "at rest"},
           into(&Net::velocity)},
          {{.name = "node", .type = nodes, .meaning = "Nodes with a mass, support, ... by place."}},
      });
  return section;
}

const Section<Ring>& ring_section() {
  static const Section<Ring> section(
      {.name = "ring",
       .named = true,
       .about = "A ring: either `on` an element of a net's edge or of a thread (centre at its midpoint, "
                "normal along "
                "it), or with a node of its own (its normal is constant)."},
      [] {
        auto rows = ring_keys<Ring>([](Ring& ring) -> Ring& { return ring; });
        const std::vector<Key<Ring>> own = {
            {{.name = "on",
              .type = name,
              .refers = a_net_edge | a_thread,
              .fallback_note = "a node of its own",
              .meaning = "Host: `net.NAME.top`, `.right`, `.bottom`, `.left` or `thread.NAME`."},
             into(&Ring::element_of)},
            {{.name = "element",
              .type = whole,
              .range = {0, 1e8, true},
              .required = true,
              .only_with = "on",
              .meaning = "Host element, counted along the edge or thread from 0."},
             into(&Ring::element)},
            {{.name = "center_m",
              .type = vector,
              .unit = "m",
              .range = coordinate,
              .required = true,
              .not_with = "on",
              .meaning = "Centre."},
             into(&Ring::center)},
            {{.name = "normal",
              .type = vector,
              .nonzero = true,
              .required = true,
              .not_with = "on",
              .meaning = "Normal of its plane (any length)."},
             [](Ring& ring, const Value& value) { ring.normal = value.vector.normalized(); }},
            {{.name = "velocity_m_s",
              .type = vector,
              .unit = "m/s",
              .range = speed,
              .fallback = "[0, 0, 0]",
              .not_with = "on",
              .meaning = "Initial velocity.",
              .source = "at rest"},
             into(&Ring::velocity)},
            {{.name = "support",
              .type = choice,
              .words = supports,
              .fallback = "\"free\"",
              .not_with = "on",
              .meaning = "`free` (moves, does not turn), `guided` along `axis`, or `fixed`.",
              .source = "no support"},
             into(&Ring::support)},
            {{.name = "axis",
              .type = vector,
              .nonzero = true,
              .fallback_note = "none; needed by `guided`",
              .not_with = "on",
              .meaning = "Direction of motion of a guided ring (any length)."},
             [](Ring& ring, const Value& value) { ring.axis = value.vector.normalized(); }},
        };
        rows.insert(rows.end(), own.begin(), own.end());
        return rows;
      }());
  return section;
}

const Section<RingRow>& rings_section() {
  static const Section<RingRow> section(
      {.name = "rings",
       .named = true,
       .about =
           "Many equal rings on the edges of a net: `[rings.r]` makes `ring.r1`, `ring.r2`, ... numbered "
           "clockwise from the first cell of the first edge, each on the middle element of its mesh side "
           "(with "
           "an even number of elements the one behind the middle)."},
      [] {
        auto rows = ring_keys<RingRow>([](RingRow& row) -> Ring& { return row.ring; });
        const std::vector<Key<RingRow>> own = {
            {{.name = "net",
              .type = name,
              .refers = a_net_name,
              .required = true,
              .meaning = "Name of a `[net.NAME]`."},
             into(&RingRow::net)},
            {{.name = "edges",
              .type = names,
              .words = {"top", "right", "bottom", "left"},
              .fallback = R"(["top", "right", "bottom", "left"])",
              .meaning = "Edges that carry rings, in order.",
              .source = "Fig. 4: rings on all edges"},
             into(&RingRow::edges)},
            {{.name = "cells",
              .type = wholes,
              .range = count,
              .words = {"all"},
              .fallback = "\"all\"",
              .meaning = "Meshes that carry a ring, counted clockwise along each edge from 1, or `all`.",
              .source = "the paper has 4 on each edge of 10 meshes; its cases use 1, 4, 7, 10"},
             into(&RingRow::cells)},
        };
        rows.insert(rows.end(), own.begin(), own.end());
        return rows;
      }());
  return section;
}

const Section<Mechanism>& mechanism_section() {
  static const Section<Mechanism> section(
      {.name = "mechanism",
       .named = true,
       .about =
           "A split closing mechanism (Sec. 2): a towing thread from a corner of a net, outwards along the "
           "net's diagonal, to a launcher that sheds the split masses a and b at the closing time. The "
           "launch "
           "velocity is `speed (cos(angle) axis + sin(angle) diagonal)`, or given as a vector."},
      joined<Mechanism>(
          {std::vector<Key<Mechanism>>{
               {{.name = "corner",
                 .type = name,
                 .refers = a_net_corner,
                 .required = true,
                 .meaning = "`net.NAME.top_left`, `.top_right`, `.bottom_right` or `.bottom_left`."},
                into(&Mechanism::corner)},
               {{.name = "launcher_mass_kg",
                 .unit = "kg",
                 .range = body,
                 .required = true,
                 .meaning = "Mass of the launcher alone, after the separation."},
                into(&Mechanism::launcher_mass)},
               {{.name = "split_mass_kg",
                 .unit = "kg",
                 .range = body,
                 .required = true,
                 .meaning = "Mass of each of the two split masses."},
                into(&Mechanism::split_mass)},
               {{.name = "towing_material",
                 .type = name,
                 .refers = a_material_name,
                 .required = true,
                 .meaning = "Name of a `[material.NAME]`."},
                into(&Mechanism::towing_material)},
               {{.name = "towing_diameter_m",
                 .unit = "m",
                 .range = thickness,
                 .required = true,
                 .meaning = "Diameter of the towing thread."},
                into(&Mechanism::towing_diameter)},
               {{.name = "towing_length_m",
                 .unit = "m",
                 .range = above(0, 1e4),
                 .fallback = "0.1",
                 .meaning = "Unstretched length of the towing thread.",
                 .source =
                     "not in the paper; 1.2 m of closing thread over a 1 m edge leaves 0.1 m at each end"},
                into(&Mechanism::towing_length)},
               {{.name = "towing_elements",
                 .type = whole,
                 .range = {1, 1e6, true},
                 .fallback = "1",
                 .meaning = "Elements of the towing thread.",
                 .source = "the net's default as well"},
                into(&Mechanism::towing_elements)},
               {{.name = "initial_stretch",
                 .range = above(0, 10),
                 .fallback_note = "the net's `stowed_factor`",
                 .meaning = "Initial over unstretched length of the towing thread.",
                 .source = "stowed with the net"},
                into(&Mechanism::initial_stretch)},
               {{.name = "launch_speed_m_s",
                 .unit = "m/s",
                 .range = from(0, 1e5),
                 .fallback = "0",
                 .not_with = "launch_velocity_m_s",
                 .meaning = "Speed at t = 0.",
                 .source = "at rest"}},
               {{.name = "launch_angle_deg",
                 .unit = "deg",
                 .range = {-180, 180, true},
                 .fallback = "0",
                 .not_with = "launch_velocity_m_s",
                 .meaning = "Angle between launch velocity and `launch_axis`.",
                 .source = "straight ahead (Sec. 5.3: 35)"}},
               {{.name = "launch_axis",
                 .type = vector,
                 .nonzero = true,
                 .fallback_note = "`x_axis` cross `y_axis` of the net",
                 .not_with = "launch_velocity_m_s",
                 .meaning = "Axis of the launch (any length).",
                 .source = "Sec. 5.3: the Z axis"}},
               {{.name = "launch_velocity_m_s",
                 .type = vector,
                 .unit = "m/s",
                 .range = speed,
                 .fallback_note = "from the three keys above",
                 .meaning = "Velocity at t = 0."},
                into(&Mechanism::launch_velocity)},
               {{.name = "separation_a_m_s",
                 .type = vector,
                 .unit = "m/s",
                 .range = speed,
                 .required = true,
                 .meaning = "Velocity that split mass a gains at the closing time (Table 3)."},
                into(&Mechanism::separation_a)},
               {{.name = "separation_b_m_s",
                 .type = vector,
                 .unit = "m/s",
                 .range = speed,
                 .required = true,
                 .meaning = "Velocity that split mass b gains at the closing time (Table 3)."},
                into(&Mechanism::separation_b)},
           },
           sphere_keys<Mechanism>("launcher_", "the launcher",
                                  [](Mechanism& m) -> Sphere& { return m.launcher_sphere; }),
           sphere_keys<Mechanism>("split_", "each split mass",
                                  [](Mechanism& m) -> Sphere& { return m.split_sphere; })}));
  return section;
}

}  // namespace cinch
