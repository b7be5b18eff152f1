// Data of the turnable net: up to 60 frames, coordinates as 16-bit integers in base64.
#pragma once
#include <string>

#include "output/result_reader.hpp"
#include "report/camera.hpp"

namespace cinch {

/// JSON for page.js (its reader is netView()); the view starts from `camera`. Large nets are thinned to whole
/// threads, and frames, so that the text stays below about 4 MB. Empty when the result has no frame or more
/// nodes than 16 bits number.
/// `model`: the result's, without masses that should not be shown.
std::string net_view_json(const Result& result, const ResultModel& model, const Camera& camera);

}  // namespace cinch
