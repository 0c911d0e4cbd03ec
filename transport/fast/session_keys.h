// Spares Fast DDS 2.9 the derivation of a key for each message that it decrypts.
#pragma once

namespace omentum::transport::fast {

/// To be called before a secured participant is made: what remembers is then part of the program
/// (session_keys.cpp says how). Whether Fast DDS asks it: true with version 2.9; one that does not derives
/// each time, which is slow and no fault.
bool remember_session_keys();

}  // namespace omentum::transport::fast
