// SPDX-License-Identifier: GPL-3.0-or-later
#include <btBulletDynamicsCommon.h>
#include <ode/ode.h>
