#pragma once

// The whole interface of the library; docs/reference/api.md says what it promises.
#include "depthmocap/actor.h"
#include "depthmocap/calibration.h"
#include "depthmocap/camera.h"
#include "depthmocap/error.h"
#include "depthmocap/ik.h"
#include "depthmocap/joints_csv.h"
#include "depthmocap/models.h"
#include "depthmocap/recording.h"
#include "depthmocap/session.h"
#include "depthmocap/tracker.h"
#include "depthmocap/version.h"
