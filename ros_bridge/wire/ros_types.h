// The messages of ros.idl as idlc makes them, by the names that ROS gives them.
#pragma once

#include <ros.h>  // generated

namespace omentum::ros {

using Header = std_msgs_msg_dds__Header_;
using Pose = geometry_msgs_msg_dds__Pose_;
using Twist = geometry_msgs_msg_dds__Twist_;
using Wrench = geometry_msgs_msg_dds__Wrench_;
using PoseStamped = geometry_msgs_msg_dds__PoseStamped_;
using WrenchStamped = geometry_msgs_msg_dds__WrenchStamped_;
using CartesianState = crtk_msgs_msg_dds__CartesianState_;
using OperatingState = crtk_msgs_msg_dds__OperatingState_;
using StringStamped = crtk_msgs_msg_dds__StringStamped_;

// X(message, the middle of its generated names)
#define OMENTUM_FOR_EACH_ROS(X)                           \
  X(PoseStamped, geometry_msgs_msg_dds__PoseStamped_)     \
  X(WrenchStamped, geometry_msgs_msg_dds__WrenchStamped_) \
  X(CartesianState, crtk_msgs_msg_dds__CartesianState_)   \
  X(OperatingState, crtk_msgs_msg_dds__OperatingState_)   \
  X(StringStamped, crtk_msgs_msg_dds__StringStamped_)

/// What Cyclone knows of a message, its name on the wire among it.
template <class M>
const dds_topic_descriptor_t& descriptor();
#define OMENTUM_DESCRIBES(M, name)                       \
  template <>                                            \
  inline const dds_topic_descriptor_t& descriptor<M>() { \
    return name##_desc;                                  \
  }
OMENTUM_FOR_EACH_ROS(OMENTUM_DESCRIBES)
#undef OMENTUM_DESCRIBES

// Hands every field to `each`, in the IDL's order: to be written or read. Texts are char pointers.
template <class F>
void fields(F&& each, Header& h) {
  each(h.stamp_.sec_), each(h.stamp_.nanosec_), each(h.frame_id_);
}
template <class F>
void fields(F&& each, geometry_msgs_msg_dds__Vector3_& v) {
  each(v.x_), each(v.y_), each(v.z_);
}
template <class F>
void fields(F&& each, Pose& p) {
  each(p.position_.x_), each(p.position_.y_), each(p.position_.z_);
  each(p.orientation_.x_), each(p.orientation_.y_), each(p.orientation_.z_), each(p.orientation_.w_);
}
template <class F>
void fields(F&& each, Twist& t) {
  fields(each, t.linear_), fields(each, t.angular_);
}
template <class F>
void fields(F&& each, Wrench& w) {
  fields(each, w.force_), fields(each, w.torque_);
}
template <class F>
void fields(F&& each, PoseStamped& m) {
  fields(each, m.header_), fields(each, m.pose_);
}
template <class F>
void fields(F&& each, WrenchStamped& m) {
  fields(each, m.header_), fields(each, m.wrench_);
}
template <class F>
void fields(F&& each, CartesianState& m) {
  fields(each, m.header_);
  fields(each, m.pose_), each(m.pose_is_valid_.data_);
  fields(each, m.twist_), each(m.twist_is_valid_.data_);
  fields(each, m.wrench_), each(m.wrench_is_valid_.data_);
}
template <class F>
void fields(F&& each, OperatingState& m) {
  fields(each, m.header_), each(m.state_), each(m.is_homed_), each(m.is_busy_);
}
template <class F>
void fields(F&& each, StringStamped& m) {
  fields(each, m.header_), each(m.string_);
}

}  // namespace omentum::ros
