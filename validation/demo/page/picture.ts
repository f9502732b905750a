// SPDX-License-Identifier: GPL-3.0-or-later
// All that the page shows of one moment: the picture and its caption, the numbers, energies and forces.
import { ForceChart } from "./charts";
import { byId, say } from "./dom";
import type { FanPanel } from "./fan";
import { MODELS, frameAt, impactAt, scalesOf, type Scales } from "./frame";
import { awaitedFrame } from "./grab";
import type { Models } from "./models";
import { hasEnded } from "./motion";
import { momentAt, showEnergies, showNumbers } from "./numbers";
import { OrbitControl } from "./orbit";
import { showPatch } from "./patch";
import { Stage } from "./stage";
import type { State } from "./state";
import { impactInWords } from "./words";

const isChecked = (id: string): boolean => byId<HTMLInputElement>(id).checked;

export class Picture {
  readonly stage = new Stage();
  readonly orbit: OrbitControl;
  readonly force = new ForceChart();
  private scales: Scales = scalesOf({ discrete: null, continuous: null });

  constructor(private readonly state: State, private readonly models: Models, private readonly fan: FanPanel, onChange: () => void) {
    this.orbit = new OrbitControl(byId("stage"), onChange);
    for (const id of ["traces", "speeds"]) byId(id).addEventListener("change", onChange);
  }

  /** To the models' latest answers. */
  rescale(): void {
    this.scales = scalesOf(this.models.motions);
  }

  /** @param asks before the guess the picture shows the fall, not yet the blow */
  draw(time: number, playing: boolean, asks: boolean): void {
    const { models: { discrete, motions, pairing, steps }, state } = this;
    const shown = asks ? (motions.discrete?.begin ?? 0) : time;
    const frame = discrete ? frameAt(motions, shown, this.scales, state.layout === "side", isChecked("traces") && !asks) : awaitedFrame(state.parameters);
    if (!isChecked("speeds")) frame.arrows = frame.arrows.filter(({ kind }) => kind !== "speed");
    if (!asks) frame.ghosts.push(...this.fan.ghosts(time, playing));
    this.stage.draw(frame, this.orbit.orbit);
    const moment = momentAt(motions, pairing, time);
    showNumbers(motions, moment);
    for (const model of MODELS) {
      const [motion, own] = [motions[model], moment.times[model]];
      showEnergies(model, motion && own !== null ? motion.energies(own) : null, motion !== null && hasEnded(motion, time));
    }
    this.force.setTime(time, motions.continuous?.end ?? Infinity);
    showPatch(motions.continuous, time);
    // A sheet and a question do not tell what they ask for.
    const tells = !asks && !document.body.classList.contains("handout");
    const impact = impactAt(steps, time);
    say("caption", impact && tells ? impactInWords(steps, impact.n) : "Falling");
  }
}
