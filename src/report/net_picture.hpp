// Still pictures of a net as inline SVG. Colours and line widths are classes that page.css sets:
//   n0..n3 net, c0..c3 closing and other threads, t0..t3 towing threads (0 slack ... 3 taut), r rings, b
//   ball, ml launchers, ms split masses, mo other masses
#pragma once
#include <string>
#include <vector>

#include "report/camera.hpp"
#include "report/chains.hpp"

namespace cinch {

/// What all pictures of one run share: the same view, the same scale.
struct PictureSet {
  const ResultModel* model = nullptr;
  std::vector<Chain> chains;
  Camera camera;
  double pixels_per_metre = 100;
  double width = 640, height = 480;  ///< of the picture, px
  double tension_reference = 1;      ///< N, see tension_level

  /// The same eye, scale and colours as another set, for pictures of several runs side by side.
  void take_view_of(const PictureSet& other);
};

/// Shared view for pictures of these frames (at least one).
PictureSet picture_set(const ResultModel& model, const std::vector<Frame>& frames, const ViewHints& hints);

/// One picture: an <svg> element. `id` must be unique in the page.
std::string net_picture(const PictureSet& set, const Frame& frame, const std::string& label,
                        const std::string& id);

}  // namespace cinch
