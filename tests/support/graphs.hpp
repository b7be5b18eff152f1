// Graphs of elements that the tests of runs, pieces and the force reduction share.
#pragma once
#include <algorithm>
#include <array>
#include <random>
#include <string>
#include <vector>

#include "scene/net_pattern.hpp"

namespace cinch::test {

struct Graph {
  std::string name;
  Index nodes = 0;
  std::vector<Index> a, b;  ///< end nodes of each element

  std::size_t size() const { return a.size(); }
  void join(Index from, Index to) {
    a.push_back(from);
    b.push_back(to);
  }
};

inline Graph net_graph(int columns, int rows, int sub) {
  Net net;
  net.mesh = 0.1;
  net.width = 0.1 * columns;
  net.height = 0.1 * rows;
  net.elements_per_side = sub;
  const NetPattern pattern(net);
  Graph g;
  g.name = "net " + std::to_string(columns) + "x" + std::to_string(rows) + "x" + std::to_string(sub);
  g.nodes = pattern.nodes();
  pattern.for_each_element([&](Index a, Index b) { g.join(a, b); });
  return g;
}

inline Graph thread_graph(Index elements) {
  Graph g{"thread " + std::to_string(elements), elements + 1, {}, {}};
  for (Index e = 0; e < elements; ++e) g.join(e, e + 1);
  return g;
}

/// A net with threads behind it that hang on it here and there, like a net with towing and closing threads.
inline Graph dressed_net_graph(int columns, int rows, int threads, Index elements) {
  Graph g = net_graph(columns, rows, 1);
  g.name = "dressed " + g.name;
  const Index knots = g.nodes;
  for (int t = 0; t < threads; ++t) {
    g.join(t * 3 % knots, g.nodes);
    for (Index e = 0; e < elements; ++e) g.join(g.nodes + e, g.nodes + e + 1);
    g.nodes += elements + 1;
  }
  return g;
}

inline Graph shuffled(Graph g, unsigned seed) {
  std::mt19937 random(seed);
  for (std::size_t e = g.size(); e > 1; --e) {
    const std::size_t other = random() % e;
    std::swap(g.a[e - 1], g.a[other]);
    std::swap(g.b[e - 1], g.b[other]);
  }
  for (std::size_t e = 0; e < g.size(); ++e)
    if (random() % 2 == 0) std::swap(g.a[e], g.b[e]);
  g.name += " shuffled";
  return g;
}

/// Any two nodes may be joined, some twice.
inline Graph random_graph(Index nodes, Index elements, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_int_distribution<Index> node(0, nodes - 1);
  Graph g{"random " + std::to_string(seed), nodes, {}, {}};
  while (static_cast<Index>(g.size()) < elements)
    if (const Index a = node(random), b = node(random); a != b) g.join(a, b);
  return g;
}

// A chain, and a run of offset 9 from its last node on: in a piece that has the chain only, the run's first
// element joins neighbours, as the nodes between are missing.
inline Graph skipping_graph() {
  Graph g{"skipping", 200, {}, {}};
  for (Index i = 0; i < 151; ++i) {
    g.a.push_back(i);
    g.b.push_back(i < 127 ? i + 1 : i + 9);
  }
  return g;
}

/// Each node is joined with those up to `reach` further on: more runs meet there than one pass takes.
inline Graph band_graph(Index nodes, Index reach) {
  Graph g{"band " + std::to_string(reach), nodes, {}, {}};
  for (Index offset = 1; offset <= reach; ++offset)
    for (Index i = 0; i + offset < nodes; ++i) g.join(i, i + offset);
  return g;
}

inline std::vector<Graph> sample_graphs() {
  std::vector<Graph> list;
  for (int sub = 1; sub <= 3; ++sub)
    for (const auto& [columns, rows] : {std::pair{1, 1}, {4, 3}, {10, 10}, {37, 12}, {90, 9}, {8, 60}}) {
      list.push_back(net_graph(columns, rows, sub));
      list.push_back(shuffled(list.back(), 7));
    }
  for (const Index n : {1, 2, 3, 4, 7, 8, 9, 255, 256, 257, 1000}) {
    list.push_back(thread_graph(n));
    list.push_back(shuffled(list.back(), 3));
  }
  list.push_back(dressed_net_graph(10, 10, 4, 240));
  list.push_back(dressed_net_graph(70, 20, 9, 33));
  for (unsigned seed = 1; seed < 7; ++seed)
    list.push_back(random_graph(50 * static_cast<Index>(seed), 200 * static_cast<Index>(seed), seed));
  list.push_back(skipping_graph());
  list.push_back(band_graph(400, 7));
  list.push_back({"empty", 5, {}, {}});
  return list;
}

}  // namespace cinch::test
