#pragma once

#include "ifov/run_control.h"
