// Data of the turnable net: up to 60 frames, coordinates as 16-bit integers in base64.
#pragma once
#include <string>

#include "output/result_reader.hpp"
#include "report/camera.hpp"

namespace cinch {

/// JSON for page.js (its reader is netView()); the view starts from `camera`. Large nets are thinned to whole threads,
/// so that the text stays below about 4 MB. Empty when the result has no frame.
std::string net_view_json(const Result& result, const Camera& camera);

}  // namespace cinch
