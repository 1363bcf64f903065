#pragma once

/// What libifov lets programs see. All else in it is hidden, so that nothing of a program can get into its way.
#define IFOV_API __attribute__((visibility("default")))
