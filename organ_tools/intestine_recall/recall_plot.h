// Recall over time as a picture.
#pragma once

#include "organ_tools/force_map/canvas.h"
#include "organ_tools/intestine_recall/recall_run.h"

namespace omentum::intestine_recall {

/// Above, how many regions collide by every pair and how many of them each search found (Raghupathi 2004,
/// fig. 14); below, which share that is, in per cent. Where several steps share a column of pixels, all of
/// their values are there.
force_map::Canvas draw_recall(const RecallReport& report, double step_s);

}  // namespace omentum::intestine_recall
