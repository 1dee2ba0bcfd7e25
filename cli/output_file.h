#pragma once

#include "tilepack/bake/output_check.h"
#include "tilepack/bake/text_file.h"
