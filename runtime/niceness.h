// How much of a busy processor ordinary threads get, beside each other.
#pragma once

namespace omentum::runtime {

/// Nice values, beside 0 of everybody else; each step of one is a quarter more of a processor that several
/// threads want. The hand waits for the organ's loop, which has three parts in four beside a thread of 0;
/// what is not real-time in a hand's own process comes before that, since the hand's loop may wait for a lock
/// that it holds; a picture is late first.
inline constexpr int kHandNice = -10;
inline constexpr int kOrganNice = -5;
inline constexpr int kPictureNice = 5;

/// Gives the calling thread, and those that it starts from now on, that value. A lower one than a thread has
/// needs permission (`nice` in limits.conf, or CAP_SYS_NICE): where it is not given, nothing changes, and the
/// answer is false.
///
/// Linux shares a processor out among sessions first (autogroups, where it has them): in a process that began
/// its own, as the launcher's nodes do, a value below 0 is the session's share as well. None above: a picture
/// that others left nothing to would stand still.
bool take_nice(int value) noexcept;

}  // namespace omentum::runtime
