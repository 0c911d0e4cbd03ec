#include "organ_tools/intestine_recall/recall_plot.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

namespace omentum::intestine_recall {
namespace {

using force_map::Canvas;
using force_map::Colour;

constexpr Colour kPaper{1, 1, 1}, kInk{0.13f, 0.14f, 0.16f}, kGrid{0.88f, 0.88f, 0.90f};
constexpr Colour kAll{0.62f, 0.63f, 0.66f};
constexpr std::array<Colour, kMethods.size()> kOfMethod{
    {{0.85f, 0.37f, 0.01f}, {0.10f, 0.37f, 0.65f}}};  // told apart without red and green, too
constexpr int kWidth = 1280, kHeight = 760, kLeft = 90, kRight = 30, kLetters = 18;
constexpr int kTop = 70, kPanel = 280, kBetween = 60, kLine = 2;  // pixels

// One of the two diagrams: what values of 0 and `most` are.
struct Panel {
  int top;
  double most;
  int y(double value) const { return top + static_cast<int>(std::lround((1 - value / most) * (kPanel - 1))); }
};

int x_of(std::size_t step, std::size_t steps) {
  const double share = static_cast<double>(step) / static_cast<double>(std::max<std::size_t>(steps, 1));
  return kLeft + static_cast<int>(share * (kWidth - kLeft - kRight));
}

std::string number(double value, const char* unit) {
  char text[40];
  std::snprintf(text, sizeof text, "%.4g%s", value, unit);
  return text;
}

class RecallPlot {
 public:
  RecallPlot(const RecallReport& report, double step_s) : report_(report), step_s_(step_s) {}

  Canvas draw() {
    std::int32_t most = 1;
    for (const RecallSample& s : report_.samples) most = std::max(most, s.regions);
    const Panel regions{kTop, 1.1 * most}, shares{kTop + kPanel + kBetween, 105};
    draw_frame(regions, "", most);
    draw_frame(shares, " %", 100);
    draw_times();
    draw_values(regions, kAll, [](const RecallSample& s) { return s.regions; });
    // the complete search first: the other one's misses lie below it
    for (std::size_t method = kMethods.size(); method-- > 0;) {
      draw_values(regions, kOfMethod[method], [method](const RecallSample& s) { return s.found[method]; });
      draw_values(shares, kOfMethod[method], [method](const RecallSample& s) {
        return s.regions > 0 ? 100.0 * s.found[method] / s.regions : 100.0;
      });
    }
    draw_legend();
    return std::move(canvas_);
  }

 private:
  void draw_frame(const Panel& panel, const char* unit, double most) {
    for (const double share : {0.0, 0.5, 1.0}) {
      canvas_.fill(kLeft, panel.y(share * most), kWidth - kLeft - kRight, 1, kGrid);
      const std::string label = number(share * most, unit);
      letters_.write(canvas_, kLeft - 10 - static_cast<int>(letters_.width(label)),
                     panel.y(share * most) - kLetters / 2, label, kInk);
    }
  }

  void draw_times() {
    const double seconds = step_s_ * static_cast<double>(report_.samples.size());
    for (int i = 0; i <= 4; ++i) {
      const int x = kLeft + i * (kWidth - kLeft - kRight) / 4;
      const std::string label = number(seconds * i / 4, " s");
      const int wide = static_cast<int>(letters_.width(label));
      letters_.write(canvas_, std::min(x - wide / 2, kWidth - wide - 4), kHeight - 40, label, kInk);
    }
  }

  void draw_values(const Panel& panel, Colour colour, const std::function<double(const RecallSample&)>& of) {
    int last = panel.y(report_.samples.empty() ? 0 : of(report_.samples.front()));
    for (std::size_t k = 0; k < report_.samples.size(); ++k) {
      const int x = x_of(k, report_.samples.size()), y = panel.y(of(report_.samples[k]));
      canvas_.fill(x, std::min(y, last), kLine, std::abs(y - last) + kLine, colour);
      const int next = x_of(k + 1, report_.samples.size());
      if (next > x) canvas_.fill(x, y, next - x, kLine, colour);
      last = y;
    }
  }

  void draw_legend() {
    letters_.write(canvas_, kLeft, 12, "colliding regions, and the share of them that is found", kInk);
    int x = kLeft;
    const auto entry = [&](const std::string& name, Colour colour) {
      canvas_.fill(x, 48, 24, 4, colour);
      letters_.write(canvas_, x + 32, 40, name, kInk);
      x += 62 + static_cast<int>(letters_.width(name));
    };
    entry("every pair", kAll);
    for (std::size_t method = 0; method < kMethods.size(); ++method)
      entry(kMethods[method], kOfMethod[method]);
  }

  const RecallReport& report_;
  double step_s_;
  Canvas canvas_{kWidth, kHeight, kPaper};
  force_map::Lettering letters_{static_cast<float>(kLetters)};
};

}  // namespace

Canvas draw_recall(const RecallReport& report, double step_s) {
  return RecallPlot(report, step_s).draw();
}

}  // namespace omentum::intestine_recall
