#pragma once

#include "core/format.h"
#include "ifov/error.h"
