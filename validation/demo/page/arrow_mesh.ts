// SPDX-License-Identifier: GPL-3.0-or-later
// An arrow in the picture: a blow, or the speed of an end.
import { ConeGeometry, CylinderGeometry, Group, Mesh, MeshBasicMaterial, Quaternion, Vector3 } from "three";
import { COLOURS } from "./colours";
import type { Arrow } from "./frame";

export class ArrowMesh {
  readonly group = new Group();
  private readonly material = new MeshBasicMaterial({ depthTest: false, transparent: true });
  private readonly shaft = new Mesh(new CylinderGeometry(1, 1, 1, 12).translate(0, 0.5, 0), this.material);
  private readonly head = new Mesh(new ConeGeometry(1, 1, 16).translate(0, -0.5, 0), this.material);

  constructor() {
    this.group.add(this.shaft, this.head);
    // A blow under a broad body would else be hidden by it.
    this.shaft.renderOrder = this.head.renderOrder = 1;
  }

  set(arrow: Arrow | undefined, thickness: number): void {
    const [x, y, z] = arrow?.vector ?? [0, 0, 0];
    const length = Math.hypot(x, y, z);
    this.group.visible = arrow !== undefined && length > 2 * thickness;
    if (!arrow || !this.group.visible) return;
    const radius = arrow.kind === "blow" ? thickness : 0.55 * thickness;
    const head = Math.min(5 * radius, 0.6 * length);
    this.material.opacity = arrow.isPast ? 0.4 : 1;
    this.material.color.set(arrow.kind === "speed" ? COLOURS.speed : COLOURS.blow[arrow.model]);
    this.group.position.set(...arrow.from);
    const direction = new Vector3(x, y, z).divideScalar(length);
    this.group.quaternion.copy(new Quaternion().setFromUnitVectors(new Vector3(0, 1, 0), direction));
    this.shaft.scale.set(radius, length - head, radius);
    this.head.scale.set(2.6 * radius, head, 2.6 * radius);
    this.head.position.set(0, length, 0);
  }
}
