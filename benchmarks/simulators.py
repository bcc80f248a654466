# pyright: basic
"""The same Jacobian from MuJoCo, Drake and KDL, called once for every configuration."""

from collections.abc import Callable

import numpy as np
from kinegrade.solutions.chain import Array, Chain

Single = Callable[[Array], Array]


def mujoco(chain: Chain) -> Single:
    """mj_kinematics, mj_comPos and mj_jacSite on a model of nested bodies."""
    import mujoco as mj

    spec = mj.MjSpec()
    body = spec.worldbody
    for i, kind in enumerate(chain.kinds):
        body = body.add_body(pos=chain.fixed[i][:3, 3], quat=_quaternion(mj, chain.fixed[i]))
        joint = {"R": mj.mjtJoint.mjJNT_HINGE, "P": mj.mjtJoint.mjJNT_SLIDE}[kind]
        body.add_joint(type=joint, axis=[0, 0, 1])
        body.mass, body.inertia, body.explicitinertial = 1.0, [1.0, 1.0, 1.0], True
    tool = chain.fixed[-1]
    body.add_site(name="tool", pos=tool[:3, 3], quat=_quaternion(mj, tool))
    model = spec.compile()
    data = mj.MjData(model)
    site = model.site("tool").id
    linear, angular = np.empty((3, chain.n)), np.empty((3, chain.n))

    def jacobian(q: Array) -> Array:
        data.qpos[:] = q
        mj.mj_kinematics(model, data)
        mj.mj_comPos(model, data)
        mj.mj_jacSite(model, data, linear, angular, site)
        return np.concatenate([linear, angular])

    return jacobian


def _quaternion(mj: object, T: Array) -> Array:
    quaternion = np.empty(4)
    mj.mju_mat2Quat(quaternion, np.ascontiguousarray(T[:3, :3]).ravel())
    return quaternion


def drake(chain: Chain) -> Single:
    """CalcJacobianSpatialVelocity of a MultibodyPlant."""
    from pydrake.math import RigidTransform, RotationMatrix
    from pydrake.multibody.plant import MultibodyPlant
    from pydrake.multibody.tree import (
        FixedOffsetFrame,
        JacobianWrtVariable,
        PrismaticJoint,
        RevoluteJoint,
        SpatialInertia,
    )

    def placed(T: Array) -> "RigidTransform":
        return RigidTransform(RotationMatrix.ProjectToRotationMatrix(T[:3, :3]), T[:3, 3])

    plant = MultibodyPlant(0.0)
    parent = plant.world_frame()
    for i, kind in enumerate(chain.kinds):
        inertia = SpatialInertia.SolidSphereWithMass(1.0, 0.1)
        body = plant.AddRigidBody(f"link{i}", inertia)
        before = plant.AddFrame(FixedOffsetFrame(f"before{i}", parent, placed(chain.fixed[i])))
        joint = {"R": RevoluteJoint, "P": PrismaticJoint}[kind]
        plant.AddJoint(joint(f"q{i}", before, body.body_frame(), [0.0, 0.0, 1.0]))
        parent = body.body_frame()
    tool = plant.AddFrame(FixedOffsetFrame("tool", parent, placed(chain.fixed[-1])))
    plant.Finalize()
    context = plant.CreateDefaultContext()
    world, by = plant.world_frame(), JacobianWrtVariable.kQDot

    def jacobian(q: Array) -> Array:
        plant.SetPositions(context, q)
        J = plant.CalcJacobianSpatialVelocity(context, by, tool, [0.0, 0.0, 0.0], world, world)
        return np.concatenate([J[3:], J[:3]])

    return jacobian


def kdl(chain: Chain) -> Single:
    """ChainJntToJacSolver of PyKDL."""
    import PyKDL

    def placed(T: Array) -> "PyKDL.Frame":
        R = PyKDL.Rotation(*T[:3, :3].ravel().tolist())
        return PyKDL.Frame(R, PyKDL.Vector(*T[:3, 3].tolist()))

    arm = PyKDL.Chain()
    fixed = PyKDL.Joint(PyKDL.Joint.Fixed)
    arm.addSegment(PyKDL.Segment(fixed, placed(chain.fixed[0])))
    for kind, C in zip(chain.kinds, chain.fixed[1:], strict=True):
        axis = PyKDL.Joint.RotZ if kind == "R" else PyKDL.Joint.TransZ
        arm.addSegment(PyKDL.Segment(PyKDL.Joint(axis), placed(C)))
    solver = PyKDL.ChainJntToJacSolver(arm)
    joints, result = PyKDL.JntArray(chain.n), PyKDL.Jacobian(chain.n)

    def jacobian(q: Array) -> Array:
        for i, value in enumerate(q.tolist()):
            joints[i] = value
        solver.JntToJac(joints, result)
        return np.array([[result[i, j] for j in range(chain.n)] for i in range(6)])

    return jacobian
