// Names inside run.vtkhdf, shared by the recorder, the reader and XDMF.
//
// /VTKHDF  attributes Version, Type              the net as ParaView >= 5.12 reads it, T frames, N nodes, E
// elements
//   Points [T N, 3]  Connectivity [2 E]  Offsets [E + 1]  Types [E]  NumberOf...  [1]
//   PointData/velocity [T N, 3]  PointData/contact_force [T N, 3]
//   CellData/tension, strain, active [T E]  CellData/part [E]
//   Steps  attribute NSteps = T, raised only when a frame is complete on disk
// /cinch   attributes format, case, title, version, ..., closing_time     what VTK has no place for
//   attribute run_id, that its checkpoint holds, too
//   rings/center, normal, force [T, R, 3]
//   joints/part, ring [J]  joints/element [T, J]  joints/waypoint [T, J, 3]     sliding ones
//   ways/connectivity [2 S]  ways/points [T P, 3]  ways/tension, active [T S]   their threads, through the
//   rings
#pragma once

namespace cinch::layout {

inline constexpr char kFormat[] = "cinch result";
inline constexpr int kFormatVersion = 1;

inline constexpr char kResultFile[] = "run.vtkhdf";
inline constexpr char kNetXdmfFile[] = "run.xdmf";
inline constexpr char kRingsXdmfFile[] = "rings.xdmf";
inline constexpr char kBallsXdmfFile[] = "balls.xdmf";
inline constexpr char kWaysXdmfFile[] = "ways.xdmf";
inline constexpr char kSummaryFile[] = "summary.json";
inline constexpr char kCheckpointFile[] = "checkpoint.h5";
inline constexpr char kReportFile[] = "report.html";

inline constexpr char kVtk[] = "/VTKHDF";
inline constexpr char kPoints[] = "/VTKHDF/Points";
inline constexpr char kConnectivity[] = "/VTKHDF/Connectivity";
inline constexpr char kVelocity[] = "/VTKHDF/PointData/velocity";
inline constexpr char kContactForce[] = "/VTKHDF/PointData/contact_force";
inline constexpr char kTension[] = "/VTKHDF/CellData/tension";
inline constexpr char kStrain[] = "/VTKHDF/CellData/strain";
inline constexpr char kActive[] = "/VTKHDF/CellData/active";
inline constexpr char kPart[] = "/VTKHDF/CellData/part";
inline constexpr char kSteps[] = "/VTKHDF/Steps";
inline constexpr char kTimes[] = "/VTKHDF/Steps/Values";
inline constexpr char kFrameCount[] = "NSteps";  // attribute of kSteps

inline constexpr char kCinch[] = "/cinch";
inline constexpr char kRunId[] = "run_id";  // attribute of kCinch
inline constexpr char kStepNumbers[] = "/cinch/step";
inline constexpr char kEnergy[] = "/cinch/energy/";
inline constexpr char kRings[] = "/cinch/rings";
inline constexpr char kRingCenter[] = "/cinch/rings/center";
inline constexpr char kRingNormal[] = "/cinch/rings/normal";
inline constexpr char kRingForce[] = "/cinch/rings/force";
inline constexpr char kJoints[] = "/cinch/joints";
inline constexpr char kJointElement[] = "/cinch/joints/element";
inline constexpr char kJointWaypoint[] = "/cinch/joints/waypoint";
inline constexpr char kWayPoints[] = "/cinch/ways/points";
inline constexpr char kWayConnectivity[] = "/cinch/ways/connectivity";
inline constexpr char kWayTension[] = "/cinch/ways/tension";
inline constexpr char kWayActive[] = "/cinch/ways/active";
inline constexpr char kBalls[] = "/cinch/balls";
inline constexpr char kMasses[] = "/cinch/masses";
inline constexpr char kParts[] = "/cinch/parts";
inline constexpr char kProbes[] = "/cinch/probes";
inline constexpr char kProbeTimes[] = "/cinch/probes/time";
inline constexpr char kProbeValues[] = "/cinch/probes/values";
inline constexpr char kRowCount[] = "rows";  // attribute of kProbes: rows that are complete on disk
inline constexpr char kEvents[] = "/cinch/events";
inline constexpr char kSummary[] = "/cinch/summary_json";

}  // namespace cinch::layout
