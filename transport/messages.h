// The messages of all topics: plain structs in omentum::msg, one header per file of idl/, which is their
// only source. idl/field.h says what comes with each of them.
#pragma once

#include "messages/all.h"  // generated into the build tree by idl/generate.py
