// SPDX-License-Identifier: GPL-3.0-or-later
// Whether the continuous model stands beside the discrete one: the tick, what a link hides, and a scene in which it has no ground.
import { byId, say } from "./dom";
import { WITHOUT_GROUND } from "./sharing";
import { lacksGround, usualLayout, type State } from "./state";

export class Both {
  private readonly tick = byId<HTMLInputElement>("with-continuous");
  /** Whether the scene is why there is one model only: the next one with a ground brings the other back. */
  private lacksGround = false;

  constructor(private readonly state: State, onChange: () => void) {
    this.tick.checked = !state.hide.includes("continuous");
    if (lacksGround()) {
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
    state.hide = [...state.hide.filter((name) => name !== "continuous"), ...(both ? [] : ["continuous"])];
  }
}
