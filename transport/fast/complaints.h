// What Fast DDS writes to its log, told with measure.
#pragma once

namespace omentum::transport::fast {

/// From now on each kind of message of Fast DDS' log is told once in this process, as a plain line on stderr:
/// its own way is coloured, on files and pipes too, and without an end. Any thread.
void tell_complaints_once();

}  // namespace omentum::transport::fast
