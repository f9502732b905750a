// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the continuous model stands beside the discrete one: the tick, a link that takes model and tick away, and a scene without ground.
import { byId, say } from "./dom";
import { WITHOUT_GROUND } from "./sharing";
import { lacksGround, usualLayout, type State } from "./state";

export class Both {
  private readonly tick = byId<HTMLInputElement>("with-continuous");
  /** Whether the scene is why there is one model only: the next one with a ground brings the other back. */
  private lacksGround = false;

  constructor(private readonly state: State, onChange: () => void) {
    const isHidden = state.hide.includes("continuous");
    this.tick.checked = !state.alone && !isHidden;
    byId("of-continuous").hidden = isHidden;
    if (lacksGround() && !isHidden) {
      this.takeScene(false);
      say("file-said", `Opened: ${WITHOUT_GROUND}`);
    }
    this.tick.addEventListener("change", () => {
      this.set(this.tick.checked);
      onChange();
    });
  }

  get areShown(): boolean {
    return this.tick.checked;
  }

  leave(): void {
    this.tick.click();
  }

  takeScene(hasGround: boolean): void {
    if (hasGround ? !this.lacksGround : !this.tick.checked) return;
    this.set(hasGround);
    this.lacksGround = !hasGround;
  }

  private set(both: boolean): void {
    const { state } = this;
    this.tick.checked = both;
    if (both && !state.lock.includes("layout")) state.layout = usualLayout(state.parameters);
    state.alone = !both;
  }
}
