#include "kernels/ring_body.hpp"

#include "kernels/kernel_table.hpp"

namespace cinch::CINCH_ISA {
namespace {

// A ring through which several threads pass pushes with a part for each.
Index push_hosts(const kernel::SlidingArguments& g, kernel::Load* loads, double& spare) {
  LoadWriter out{loads};
  spare = HUGE_VAL;
  for (Index t = 0; t < g.thread_count; ++t)
    for (Index j = g.threads[t].joint_begin; j < g.threads[t].joint_end; ++j) {
      const kernel::Joint& joint = g.joints[j];
      if (joint.host_a == joint.host_b) continue;  // no element
      const ShortHost host = short_host(g.contact, joint);
      if (host.spare < spare) spare = host.spare;
      if (!(host.spare < 0 && host.length > 0)) continue;
      const V3 push = (joint.host_stiffness * -host.spare / host.length) * host.along;
      out.add(joint.host_a, -1.0 * push);
      out.add(joint.host_b, push);
    }
  return static_cast<Index>(out.next - loads);
}

}  // namespace

void fill_ring_body(KernelTable& table) { table.push_hosts = push_hosts; }

}  // namespace cinch::CINCH_ISA
