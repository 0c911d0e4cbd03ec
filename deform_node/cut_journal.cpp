#include "deform_node/cut_journal.h"

#include "files/console.h"
#include "files/whole_file.h"
#include "scene/scene_values.h"
#include "transport/messages.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <stdexcept>
#include <utility>

namespace omentum::deform {

namespace {

using Json = nlohmann::json;

constexpr const char* kFormat = "omentum cuts 1";
// Where a file does not say which versions were used: ten years of a hundred cuts a second.
constexpr std::uint64_t kUnreached = std::uint64_t{1} << 35;
// No journal names more: above it none could follow.
constexpr std::uint64_t kHighest = std::uint64_t{1} << 62;
// Both bit sets of all organs twice as long in digits, and room for the words between them.
constexpr std::uintmax_t kMostBytes = msg::MAX_ORGANS * (4 * msg::MAX_REMOVED_BYTES + 4096);

[[noreturn]] void refuse(const std::string& place, const std::string& found, const std::string& expected) {
  constexpr std::size_t kMostQuoted = 80;  // characters of what anybody may have written
  throw std::runtime_error(place + ": found " + scene::printable(found.substr(0, kMostQuoted)) +
                           ", expected " + expected);
}

std::string digits_of(const std::vector<std::uint8_t>& bits, std::size_t bytes) {
  constexpr const char* kDigits = "0123456789abcdef";
  std::string digits(2 * bytes, '0');
  for (std::size_t i = 0; i < std::min(bits.size(), bytes); ++i) {
    digits[2 * i] = kDigits[bits[i] >> 4];
    digits[2 * i + 1] = kDigits[bits[i] & 15];
  }
  return digits;
}

std::size_t bytes_of(const JournalScene::Organ& organ) {
  return (organ.tetrahedra + 7) / 8;
}

const Json& member(const Json& object, const char* key, const std::string& place) {
  if (!object.is_object() || !object.contains(key)) refuse(place + key, "nothing", "a value");
  return object[key];
}

std::string text(const Json& object, const char* key, const std::string& place) {
  const Json& value = member(object, key, place);
  if (!value.is_string()) refuse(place + key, value.type_name(), "a text");
  return value.get<std::string>();
}

std::uint64_t number(const Json& object, const char* key, const std::string& place) {
  const Json& value = member(object, key, place);
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > kHighest)
    refuse(place + key, value.is_number() ? value.dump() : value.type_name(), "a count");
  return value.get<std::uint64_t>();
}

std::vector<std::uint8_t> bit_set(const Json& object, const char* key, const std::string& place,
                                  const JournalScene::Organ& organ) {
  const std::string digits = text(object, key, place);
  std::vector<std::uint8_t> bits(bytes_of(organ));
  if (digits.size() != 2 * bits.size())
    refuse(place + key, std::to_string(digits.size()) + " digits", std::to_string(2 * bits.size()));
  for (std::size_t i = 0; i < bits.size(); ++i) {
    const char* const begin = digits.data() + 2 * i;
    if (std::from_chars(begin, begin + 2, bits[i], 16).ptr != begin + 2)
      refuse(place + key, digits.substr(2 * i, 2), "hexadecimal digits");
  }
  if (organ.tetrahedra % 8 != 0 && bits.back() >> organ.tetrahedra % 8 != 0)
    refuse(place + key, "a tetrahedron beyond the organ's", std::to_string(organ.tetrahedra) + " of them");
  return bits;
}

// A part that is precomputed has its tensors as it is: without a tetrahedron they would be wrong.
void refuse_kept(const std::vector<std::uint8_t>& removed, const JournalScene::Organ& organ,
                 const std::string& place) {
  for (std::size_t t = 0; t < organ.kept.size(); ++t) {
    if (organ.kept[t] != 0 && (removed[t / 8] >> t % 8 & 1) != 0)
      refuse(place, "tetrahedron " + std::to_string(t) + ", which is precomputed",
             "tetrahedra of the dynamic part");
  }
}

OrganCuts cuts_of(const Json& entry, const JournalScene::Organ& organ, const std::string& place) {
  const std::string hash = text(entry, "hash", place);
  if (hash != organ.hash) refuse(place + "hash", hash, organ.hash + ", that of organ " + organ.name);
  const std::uint64_t tetrahedra = number(entry, "tetrahedra", place);
  if (tetrahedra != organ.tetrahedra)
    refuse(place + "tetrahedra", std::to_string(tetrahedra), std::to_string(organ.tetrahedra));
  OrganCuts cuts{.version = number(entry, "version", place),
                 .removed_bits = bit_set(entry, "removed", place, organ),
                 .burnt_bits = bit_set(entry, "burnt", place, organ)};
  for (std::size_t i = 0; i < cuts.removed_bits.size(); ++i)
    if ((cuts.burnt_bits[i] & ~cuts.removed_bits[i]) != 0)
      refuse(place + "burnt", "a tetrahedron that is not removed", "some of those");
  refuse_kept(cuts.removed_bits, organ, place + "removed");
  if (cuts.version == 0 && std::ranges::any_of(cuts.removed_bits, [](auto byte) { return byte != 0; }))
    refuse(place + "version", "0 of a cut organ", "more than that");
  return cuts;
}

std::vector<OrganCuts> cuts_of(const Json& document, const JournalScene& scene, const std::string& file) {
  const std::string place = file + ": ";
  if (const std::string format = text(document, "format", place); format != kFormat)
    refuse(place + "format", format, kFormat);
  if (const std::string hash = text(document, "scene", place); hash != scene.hash)
    refuse(place + "scene", hash, scene.hash + ", this scene's");
  const Json& organs = member(document, "organs", place);
  if (!organs.is_array() || organs.size() != scene.organs.size())
    refuse(place + "organs", std::to_string(organs.size()), std::to_string(scene.organs.size()));
  std::vector<OrganCuts> cuts;
  for (std::size_t i = 0; i < organs.size(); ++i)
    cuts.push_back(cuts_of(organs[i], scene.organs[i], place + "organs[" + std::to_string(i) + "]."));
  return cuts;
}

Json load(const std::filesystem::path& file) {
  const std::uintmax_t size = std::filesystem::file_size(file);
  if (size > kMostBytes)
    refuse(file.string(), std::to_string(size) + " bytes", "at most " + std::to_string(kMostBytes));
  std::ifstream stream(file, std::ios::binary);
  Json document = Json::parse(stream, nullptr, false);
  if (document.is_discarded()) refuse(file.string(), "no JSON, or part of it", "a whole journal");
  return document;
}

// Above every one that `document` names, whatever else is wrong with it.
std::uint64_t next_version(const Json& document) {
  if (!document.is_object() || !document.contains("organs") || !document["organs"].is_array())
    return kUnreached;
  std::uint64_t highest = 0;
  for (const Json& entry : document["organs"]) {
    const bool has_one =
        entry.is_object() && entry.contains("version") && entry["version"].is_number_unsigned();
    const std::uint64_t version = has_one ? entry["version"].get<std::uint64_t>() : kUnreached;
    if (version <= kHighest) highest = std::max(highest, version);
  }
  return highest + 1;
}

// Who has no tensors of a part moves all of the organ.
std::vector<std::uint8_t> kept_of(const organ::Organ& organ) {
  const bool has_part = organ.split && organ.split->compliance;
  return has_part ? organ.split->precomputed() : std::vector<std::uint8_t>{};
}

}  // namespace

JournalScene journal_scene(const std::string& scene_hash, const std::vector<ServedOrgan>& organs) {
  JournalScene scene{.hash = scene_hash, .organs = {}};
  for (const ServedOrgan& served : organs) {
    const organ::Organ& organ = served.source->organ;
    const bool can_be_cut = served.model->sizes().removed_bytes > 0;
    scene.organs.push_back({.name = organ.name,
                            .hash = organ.hash,
                            .tetrahedra = can_be_cut ? organ.mesh.tetrahedra.size() : 0,
                            .kept = kept_of(organ)});
  }
  return scene;
}

std::string journal_text(const JournalScene& scene, std::span<const OrganCuts> cuts) {
  Json document = {{"format", kFormat}, {"scene", scene.hash}, {"organs", Json::array()}};
  for (std::size_t i = 0; i < cuts.size(); ++i) {
    const JournalScene::Organ& organ = scene.organs[i];
    document["organs"].push_back({{"name", organ.name},
                                  {"hash", organ.hash},
                                  {"tetrahedra", organ.tetrahedra},
                                  {"version", cuts[i].version},
                                  {"removed", digits_of(cuts[i].removed_bits, bytes_of(organ))},
                                  {"burnt", digits_of(cuts[i].burnt_bits, bytes_of(organ))}});
  }
  return document.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

JournalContents read_journal(const std::filesystem::path& file, const JournalScene& scene) {
  JournalContents contents{.organs = std::vector<OrganCuts>(scene.organs.size()), .flaw = {}};
  Json document;
  try {
    if (!std::filesystem::exists(file)) return contents;
    document = load(file);
    contents.organs = cuts_of(document, scene, file.string());
  } catch (const std::runtime_error& error) {
    contents.flaw = error.what();
    contents.organs.assign(scene.organs.size(), OrganCuts{.version = next_version(document)});
  }
  return contents;
}

CutJournal::CutJournal(std::filesystem::path file, JournalScene scene, runtime::FaultList& faults)
    : file_(std::move(file)), scene_(std::move(scene)), faults_(faults), kept_(scene_.organs.size()) {}

std::vector<OrganCuts> CutJournal::read() const {
  JournalContents contents = read_journal(file_, scene_);
  if (!contents.flaw.empty()) {
    files::say("deform_node: " + contents.flaw + "; ignored, the organs are whole");
    faults_.raise("cuts: the journal cannot be used, the organs are whole");
  }
  return std::move(contents.organs);
}

void CutJournal::keep(std::span<const OrganSnapshot> organs) {
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    if (kept_[i].version == organs[i].topology_version) continue;
    kept_[i] = {organs[i].topology_version, organs[i].removed_bits, organs[i].burnt_bits};
    is_due_ = true;
  }
  if (!is_due_) return;
  try {
    files::write_whole(file_, journal_text(scene_, kept_));
    is_due_ = false;
  } catch (const std::runtime_error&) {
    faults_.raise("cuts: the journal cannot be written, a node started again will not know them");
  }
}

}  // namespace omentum::deform
