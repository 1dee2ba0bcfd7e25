#include "tilepack/report/quality_note.h"

#include "tilepack/error/field.h"
#include "tilepack/report/bake_verdict.h"

namespace tilepack {

void note_quality(const Pack& pack, Report& report) {
  for (const BakeRemark& remark : pack_verdict(pack).remarks)
    if (remark.grade == Grade::poor)
      report.issues.push_back({Rule::set_poor, "pack.json: synthesis",
                               spelled(remark.text, FieldSpelling::option), "no figure that is called poor"});
}

} // namespace tilepack
