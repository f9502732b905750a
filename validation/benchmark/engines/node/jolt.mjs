// SPDX-License-Identifier: GPL-3.0-or-later
// Jolt: single precision, impulses with speculative contacts.  The rod is a capsule over a box.
import load from 'jolt-physics/wasm-compat';
import { runAll, versionOf } from './problem.mjs';

const jolt = await load();
const [FIXED, MOVING] = [0, 1];
const vector = ([x, y, z]) => new jolt.Vec3(x, y, z);
const place = ([x, y, z]) => new jolt.RVec3(x, y, z);
const rotation = ([w, x, y, z]) => new jolt.Quat(x, y, z, w);
const array = v => [v.GetX(), v.GetY(), v.GetZ()];

function makeWorld() {
  const settings = new jolt.JoltSettings();
  const pairs = new jolt.ObjectLayerPairFilterTable(2);
  pairs.EnableCollision(FIXED, MOVING);
  const layers = new jolt.BroadPhaseLayerInterfaceTable(2, 2);
  for (const layer of [FIXED, MOVING]) layers.MapObjectToBroadPhaseLayer(layer, new jolt.BroadPhaseLayer(layer));
  settings.mObjectLayerPairFilter = pairs;
  settings.mBroadPhaseLayerInterface = layers;
  settings.mObjectVsBroadPhaseLayerFilter = new jolt.ObjectVsBroadPhaseLayerFilterTable(layers, 2, pairs, 2);
  return new jolt.JoltInterface(settings);
}

function useTunedSettings(system) {
  const settings = system.GetPhysicsSettings();  // PhysicsSettings.h gives meanings and defaults
  settings.mMinVelocityForRestitution = 0;       // 1 m/s
  settings.mSpeculativeContactDistance = 1e-6;   // 0.02 m: contacts before bodies touch
  settings.mPenetrationSlop = 0;                 // 0.02 m
  settings.mBaumgarte = 0;                       // 0.2
  settings.mNumVelocitySteps = 50;               // 10
  settings.mNumPositionSteps = 0;                // 2
  settings.mAllowSleeping = false;
  system.SetPhysicsSettings(settings);
}

function shapeOf(problem) {
  if (!problem.rod) {
    const half = [problem.length, problem.width, problem.height].map(extent => extent / 2);
    // Convex shapes are rounded by 0.05 m by default, or less where they are thin.
    return new jolt.BoxShape(vector(half), problem.tuned ? 0 : Math.min(0.05, ...half));
  }
  const turn = rotation([Math.SQRT1_2, 0, 0, Math.SQRT1_2]);  // a capsule lies along y, the rod along x
  const capsule = new jolt.CapsuleShapeSettings(problem.length / 2, problem.radius);
  return new jolt.RotatedTranslatedShapeSettings(vector([0, 0, 0]), turn, capsule).Create().Get();
}

function addFloor(bodies) {
  const shape = new jolt.BoxShape(vector([100, 100, 10]), 0.05);
  const floor = new jolt.BodyCreationSettings(shape, place([0, 0, -10]), rotation([1, 0, 0, 0]), jolt.EMotionType_Static, FIXED);
  floor.mRestitution = 0;  // of a contact: the larger one
  floor.mFriction = 1;     // of a contact: the root of the product
  bodies.AddBody(bodies.CreateBody(floor).GetID(), jolt.EActivation_DontActivate);
}

function addBody(problem, bodies) {
  const settings = new jolt.BodyCreationSettings(shapeOf(problem), place(problem.position), rotation(problem.attitude),
                                                 jolt.EMotionType_Dynamic, MOVING);
  settings.mRestitution = problem.restitution;
  settings.mFriction = problem.friction ** 2;
  settings.mLinearDamping = settings.mAngularDamping = 0;  // 0.05/s each by default
  settings.mLinearVelocity = vector(problem.velocity);
  settings.mAngularVelocity = vector(problem.angular_velocity);
  settings.mMaxAngularVelocity = 1e4;
  settings.mApplyGyroscopicForce = problem.tuned;  // BodyCreationSettings.h: off by default
  settings.mOverrideMassProperties = jolt.EOverrideMassProperties_MassAndInertiaProvided;
  const inertia = jolt.Mat44.prototype.sIdentity();
  const [x, y, z] = problem.inertia;
  inertia.SetAxisX(vector([x, 0, 0]));
  inertia.SetAxisY(vector([0, y, 0]));
  inertia.SetAxisZ(vector([0, 0, z]));
  settings.mMassPropertiesOverride.mMass = problem.mass;
  settings.mMassPropertiesOverride.mInertia = inertia;
  const body = bodies.CreateBody(settings);
  bodies.AddBody(body.GetID(), jolt.EActivation_Activate);
  return body;
}

function simulate(problem, trajectory) {
  const world = makeWorld();
  const system = world.GetPhysicsSystem();
  system.SetGravity(vector([0, 0, -problem.gravity]));
  if (problem.tuned) useTunedSettings(system);
  const bodies = system.GetBodyInterface();
  addFloor(bodies);
  const body = addBody(problem, bodies);
  trajectory.recordSpatial(() => world.Step(problem.step, 1), () => {
    const q = body.GetRotation();
    const attitude = [q.GetW(), q.GetX(), q.GetY(), q.GetZ()];
    return { position: array(body.GetCenterOfMassPosition()), attitude,
             velocity: array(body.GetLinearVelocity()), spin: array(body.GetAngularVelocity()) };
  });
  jolt.destroy(world);
}

await runAll({ name: 'Jolt', version: versionOf('jolt-physics') }, simulate);
