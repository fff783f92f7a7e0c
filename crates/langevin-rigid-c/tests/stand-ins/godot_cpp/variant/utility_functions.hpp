#pragma once

#include <godot_cpp/classes/node3d.hpp>
