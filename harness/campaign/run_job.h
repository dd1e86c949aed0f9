#pragma once

#include "harness/campaign/job.h"

namespace aisle {

/// Makes one run in this process and files it: opens the sequence, drives the system through it,
/// scores, writes the run's folder. Progress goes to stdout, as lines "@progress I N" and
/// "@stage WHAT" for the scheduler that started the process.
void RunJob(const Job& job);

}  // namespace aisle
