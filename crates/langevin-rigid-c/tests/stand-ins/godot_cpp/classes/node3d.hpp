// What the page on Godot uses of godot-cpp, declared as there: for the compiler, not to be run.

#pragma once

#include <cstdint>

#define GDCLASS(name, parent)
#define D_METHOD(...) 0

namespace godot {

typedef double real_t;

struct Vector3 {
    real_t x = 0, y = 0, z = 0;
    Vector3() {}
    Vector3(real_t x, real_t y, real_t z);
};

struct Quaternion {
    real_t x = 0, y = 0, z = 0, w = 1;
    Quaternion() {}
    Quaternion(real_t x, real_t y, real_t z, real_t w);
};

struct Basis {
    Basis(const Quaternion &turn);
    Quaternion get_rotation_quaternion() const;
};

struct PackedByteArray {
    const uint8_t *ptr() const;
    int64_t size() const;
};

class Node3D {
public:
    virtual ~Node3D() {}
    virtual void _ready() {}
    virtual void _physics_process(double) {}
    void set_physics_process(bool enable);
    uint64_t get_instance_id() const;
    Vector3 get_global_position() const;
    void set_global_position(const Vector3 &position);
    Basis get_global_basis() const;
    void set_global_basis(const Basis &basis);
};

struct Engine {
    static Engine *get_singleton();
    bool is_editor_hint() const;
};

struct FileAccess {
    static PackedByteArray get_file_as_bytes(const char *path);
};

struct UtilityFunctions {
    static void push_error(const char *message);
};

struct ClassDB {
    template <class M> static void bind_method(int definition, M method);
};

} // namespace godot
