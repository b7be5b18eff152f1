// What a probe measures: its columns and their values.
#pragma once
#include <vector>

#include "plan/look.hpp"

namespace cinch {

/// Columns of all probes of a scene, in order. Vectors have three, "NAME.x" and so on; forces a fourth,
/// "NAME.magnitude". Throws CaseError for a probe of a part that does not exist or does not have the
/// quantity.
std::vector<ResultModel::ProbeColumn> probe_columns(const Scene& scene, const Assembly& assembly);

/// Whether a probe asks how far a node has come.
bool needs_node_start(const Scene& scene);

/// Values of the columns; `energy` as the ledger has it, `nodes_at_start` and `rings_at_start` are positions
/// at t = 0, the former empty where none is needed.
std::vector<double> probe_values(const Scene& scene, const Look& now, const Energies& energy,
                                 const std::vector<Vec3>& nodes_at_start,
                                 const std::vector<Vec3>& rings_at_start);

}  // namespace cinch
