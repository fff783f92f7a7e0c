

def set_added_mass(model, geom):
    """Gives a geom the added mass and its body the buoyancy; returns the largest term left out.

    One geom stands for the whole hull: a mesh geom of the same mesh, wherever it is on its body, its asset
    scaled to metres and without refpos or refquat; or a primitive whose centre stands for CENTROID and
    whose axes for those of the mesh. The <geom> needs fluidshape="ellipsoid", and fluidcoef for drag and
    lift; the <body> needs gravcomp="1", which is replaced. mj_setConst undoes it: call this after.
    """
    geom = model.geom(geom).id
    body = model.geom_bodyid[geom]
    if model.geom_fluid[geom, 0] == 0 or model.body_gravcomp[body] == 0:
        raise ValueError('give the <geom> fluidshape="ellipsoid" and its <body> gravcomp="1"')
    tensor = in_frame_of(model, geom)
    model.geom_fluid[geom, 6:12] = np.diag(tensor)
    model.body_gravcomp[body] = model.opt.density * VOLUME / model.body_mass[body]
    unit = np.repeat([1, VOLUME ** (1 / 3)], 3)
    sizes = np.abs(tensor) / np.outer(unit, unit)
    return (sizes - np.diag(np.diag(sizes))).max() / np.diag(sizes).max()


def in_frame_of(model, geom):
    """The tensor about the origin of a geom, in its axes."""
    offset, axes = np.zeros(3), np.eye(3)
    if model.geom_type[geom] == mujoco.mjtGeom.mjGEOM_MESH:
        mesh = model.geom_dataid[geom]
        offset = model.mesh_pos[mesh] - CENTROID
        mujoco.mju_quat2Mat(axes.reshape(9), model.mesh_quat[mesh])
    motion = np.block([[axes, np.cross(offset, axes, axisb=0, axisc=0)], [np.zeros((3, 3)), axes]])
    return motion.T @ ADDED_MASS @ motion
