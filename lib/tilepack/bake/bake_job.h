#pragma once

#include "tilepack/bake/bake.h"
#include "tilepack/bake/bake_fields.h"
#include "tilepack/bake/material_files.h"
#include "tilepack/bake/stage_clock.h"
#include "tilepack/error/error.h"
#include "tilepack/error/progress.h"
#include "tilepack/pack/pack_json.h"

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tilepack {

/// One pack to be baked, as data: what a command line, or an entry of a manifest, asks for.
///
///   BakeJob job{.sample = "rock.png", .settings = {{"colors", "3", field("colors")}}, .folder = "rock.pack"};
///   files_read(job); canonical_options(job); peak_memory(job);     // without running it
///   BakedJob made = run(job);                                      // the pack is in its folder
///
/// Paths are relative to the current folder. Every Error that blames a field is passed on with the place where
/// the field was set, however late it is found out: that of the setting ("wall.json: \"layout\""), else
/// `place` with the field's name, else field("layout") as it came.
///
/// Verdicts are found by rooms above this one: `require` and `apply_advice` are kept by the JobWatch that whoever runs
/// the job gives it.
struct BakeJob {
  std::string name = {};                    ///< what progress calls it; may be empty
  std::string sample = {};                  ///< an image, or what else sample_files() takes
  std::vector<std::string> transition = {}; ///< in place of `sample`: 2 to 4 of them, for baked_transition()
  std::vector<MaterialFile> maps = {};      ///< further maps of the material, after those of `sample`
  std::string preset = {};                  ///< a built-in one or a file; empty: none
  std::vector<BakeSetting> settings = {};   ///< these override the preset's
  std::optional<Encoding> encoding = {};    ///< of color samples; unset: as their files say
  std::string channels = {}; ///< of color samples, by name: "R,G,B"; empty: as channel_choice.h has it
  std::int64_t max_texels = usual_most_texels; ///< samples of more are refused before memory is taken
  std::string require = {};                    ///< worst grade that is kept, "good" or "fair"; empty: any
  bool apply_advice = false;                   ///< bake again with what the verdict advises
  std::string folder = {};                     ///< of the pack
  std::string report = {};                     ///< page about the pack, FILE.html; empty: none
  std::string depfile = {};                    ///< rule for make or ninja; empty: none
  std::string place = {}; ///< where the job is asked for: "manifest.json:12"; empty: unsaid
};

/// The preset's settings and then the job's own.
std::vector<BakeSetting> settings_of(const BakeJob& job);

/// Throws Error (usage, or invalid_content where the job has a place) for "apply-advice" of a transition: what a verdict
/// advises is for a bake of one material.
inline void check_advice(const BakeJob& job) {
  if (job.transition.empty() || !job.apply_advice) return;
  const Error error(ErrorKind::usage, field("apply-advice"),
                    "does not go with " + field("transition") + "; give what the verdict names by hand");
  throw blamed(error, job.place, job.settings);
}

/// What the materials of a transition are called: as their files and folders, in letters, digits, '-' and '_', each
/// once.
std::vector<std::string> material_names_of(const BakeJob& job);

/// What they come to. Throws as preset_called, bake_options and, for a transition, transition_options do.
BakeOptions options_of(const BakeJob& job);

/// The maps of the material, the main one first; of a transition, of one material after the other. A map that is named goes before one of that name that was found
/// in a folder. Throws as sample_files does.
std::vector<MaterialFile> maps_of(const BakeJob& job);

/// A line a file that looks like a map of the material and isn't taken, with marked fields; of many the first.
std::vector<std::string> notes_on_material(const BakeJob& job);

/// Every file that decides what the pack holds: the maps, and the preset if it is a file.
std::vector<std::string> files_read(const BakeJob& job);

/// What is known of the files written before the job has run: pack.json, then the report and the depfile if
/// they are asked for. The images depend on the sample; see the overload for BakedJob.
std::vector<std::string> files_written(const BakeJob& job);

/// All that reaches the bytes of the pack besides the content of the maps' files, as lines "KEY=VALUE\n" in
/// alphabetical order: every field of bake_fields() with defaults filled in (empty: left to what the sample or
/// the set asks for), "channels", "encoding", "maps" (NAME:ROLE in order, and what else their
/// names say, without their files) and "version" (of
/// tilepack). Two jobs with the same text and the same content of maps make the same pack. Where an option was
/// set, from which preset, and what the files are called has no say in it, but for the names of a transition's materials.
std::string canonical_options(const BakeJob& job);

/// Most bytes that run() will hold at a time, the program itself included: an estimate from the headers of the
/// maps and the options (bake/memory_estimate.h says how good it is). Reads no texel.
std::int64_t peak_memory(const BakeJob& job);

/// A pack that a job has made and stored.
struct BakedJob {
  std::vector<SampleMap> samples; ///< as read and prepared
  BakedPack made;
  PackDescription description;    ///< of made.pack, as written
  std::vector<StageShare> stages; ///< what took the time
  double read_seconds = 0;
  double bake_seconds = 0;
  double write_seconds = 0;
};

/// Every file of a job that has run: the pack's, then as files_written(job).
std::vector<std::string> files_written(const BakeJob& job, const BakedJob& baked);

/// Who wants to know how a job gets on. All may be empty; all may throw to cancel it, and then nothing is
/// written.
struct JobWatch {
  JobProgress progress = {};

  /// Makes the pack in place of baked(), not of baked_transition(); it has to call in some way; throwing refuses what was made.
  std::function<BakedPack(std::span<const SampleMap> samples, const BakeOptions& options,
                          const Progress& progress)>
      make = {};

  /// Called when the pack is made and nothing is written; throwing refuses it.
  std::function<void(const BakedJob& baked)> accept = {};

  /// Takes a line for the user, with marked fields, as soon as there is something to tell.
  std::function<void(std::string_view line)> note = {};

  /// Called when the pack is made, from another thread while its files are written: a chance to work out what
  /// a report says meanwhile. `description` is there, times are not.
  std::function<void(const BakedJob& baked)> made = {};

  /// The text of the page `report`, asked for after `made`, when all else is written and nothing is in place
  /// yet; times of writing are not yet whole. Empty: nobody writes a page.
  std::function<std::string(const BakedJob& baked)> page = {};
};

/// Reads the maps, bakes them, and writes the pack, the depfile and the page `report`, put in place together: all
/// or nothing, the pack last (StagedOutputs). Before the long work it is made sure that they can be written and
/// replace nothing that is read. What the page shows is found by rooms above this one, so its text comes from
/// JobWatch::page.
///
/// Throws Error as baked(), write_pack() and read_image() do; usage if outputs and inputs meet, or sample or
/// folder are missing.
BakedJob run(const BakeJob& job, const JobWatch& watch = {});

} // namespace tilepack
