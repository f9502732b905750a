// SPDX-License-Identifier: GPL-3.0-or-later
// The page: from a change of the situation to the requests, and from their answers to the panels.
import { ApiError } from "./api";
import { seenAngle } from "./body";
import { Both } from "./both";
import { Capture } from "./capture";
import { showProfile } from "./charts";
import { Controls } from "./controls";
import { byId } from "./dom";
import { explaining } from "./explain";
import { FanPanel } from "./fan";
import { impactAt, type ModelName } from "./frame";
import { InHand } from "./grab";
import { AngleMap } from "./map";
import { Models } from "./models";
import { Tabs, Waiting, hidePanels, setUpLayout, setUpLecture, setUpOpening, setUpPrinting } from "./panels";
import { bodyOf, isInPlane, isUsed } from "./parameters";
import { Picture } from "./picture";
import { Player, TimeWarp, Transport } from "./playback";
import { Prediction } from "./prediction";
import { dropOf, explainRequest } from "./requests";
import { SceneFile, download, setUpSharing } from "./sharing";
import { Strip } from "./sketch";
import { Sound } from "./sound";
import { isFixed, readAddress, usualLayout, wrongInAddress, writeAddress, type State } from "./state";
import { Story } from "./story";
import { ImpactTable, csvOf } from "./table";
import { setUpTracks } from "./tracks";
import { outcomeInWords, showNotes, showWarnings } from "./words";

/** After a change, until the drop is played [ms]. */
const PLAY_DELAY = 350;

class Page {
  private readonly state: State = readAddress();
  private asked = 0;
  /** Until the first answer the time is that of the link. */
  private hasShown = false;
  /** Whether the time is that of the chosen impact, or one that was sought. */
  private followsImpact = false;
  private playTimer = 0;
  /** The impact that the reader chose, whose equations stand there while another one is played. */
  private explained = this.state.impact;
  /** The drop that the question was last about. */
  private askedOf = dropOf(this.state.parameters);
  private isBroken = false;

  private readonly table = new ImpactTable((model, n) => this.goToImpact(model, n));
  private readonly fan = new FanPanel(this.state, () => { this.draw(); writeAddress(this.state); });
  private readonly models = new Models(
    () => this.onAnswer(), (model, error) => this.onError(model, error), (busy) => this.waiting.show(busy));
  private readonly picture = new Picture(this.state, this.models, this.fan, () => this.draw());
  private readonly strip = new Strip((model, n) => this.goToImpact(model, n));
  private readonly sound = new Sound(this.state.lock.includes("sound"));
  private readonly tabs = new Tabs(this.state, () => this.remember());
  private readonly showLayout: () => void;
  private wasInPlane = isInPlane(this.state.parameters);
  private playedTo = -Infinity;
  private readonly map = new AngleMap((angle) => this.setAngle(angle));
  private readonly player = new Player(new TimeWarp(0, 1), (_time, ended) => this.onTime(ended));
  private readonly controls = new Controls(this.state, () => this.change(), () => this.playSoon());
  private readonly prediction = new Prediction((asksOn) => this.onPredicted(asksOn));
  private readonly transport = new Transport(this.state, {
    toggle: () => this.toggle(),
    step: (direction) => this.goTo(this.state.impact + direction, direction),
    scrub: (progress) => this.scrub(progress),
    setRate: (rate) => { this.state.rate = this.player.rate = rate; this.remember(); },
    playReal: () => this.playReal(),
    setSlow: (slow) => { this.state.slow = slow; this.rewarp(); this.remember(); },
  });

  private readonly hand = new InHand(this.state, this.picture.stage, this.picture.orbit, {
    motion: () => this.models.motions.discrete,
    time: () => (this.prediction.isOpen ? this.models.motions.discrete?.begin ?? 0 : this.player.time),
    onHold: () => {
      this.player.pause();
      clearTimeout(this.playTimer);
      this.draw();
    },
    onDrop: () => {
      this.controls.refresh();
      this.followsImpact = false;
      this.change();
      this.playSoon(0);
    },
  });

  private readonly both = new Both(this.state, () => this.update());
  private readonly waiting = new Waiting(() => this.both.leave());
  private readonly capture = new Capture(() => this.picture.stage.redraw(), () => { if (!this.prediction.isOpen) this.playAnew(); });

  private readonly story = new Story(this.state, {
    onEnter: () => {
      this.showAnew();
      this.followsImpact = false;
      this.state.time = -Infinity;
    },
    onPlay: () => {
      if (!matchMedia("(prefers-reduced-motion: reduce)").matches) return this.playSoon(0);
      this.goTo(this.state.impact);
      this.state.time = NaN;  // if the drop is still being computed
    },
    onStop: (time) => {
      this.player.pause();
      this.player.seek(time);
      this.onTime();
    },
    onShow: () => this.showAnew(),
  });

  constructor() {
    const { state } = this;
    hidePanels(state);
    setUpOpening();
    this.player.rate = state.rate;
    this.showLayout = setUpLayout(state, () => this.onTime());
    new SceneFile(state, (hasGround) => {
      this.both.takeScene(hasGround);
      this.player.pause();
      this.controls.refresh();
      this.change();
    });
    setUpSharing(state, (asks) => { if (asks) this.prediction.open(); });
    byId("csv").addEventListener("click", () => download("impacts.csv", csvOf(this.models.impacts), "text/csv"));
    if (state.predict) this.prediction.open();
    setUpPrinting(state, () => [state.impact, this.player.time], (n, time) => this.put(n, time));
    setUpLecture((on) => this.prediction.setVoting(on), () => this.onTime());
    const wrong = wrongInAddress(state);
    if (wrong) this.controls.setError("address", new ApiError(wrong));
    // Another link to this page, opened where it stands; the one to the motion is no other scene.
    addEventListener("hashchange", () => location.reload());
    document.querySelector(".skip")?.addEventListener("click", (event) => {
      event.preventDefault();
      byId("motion").focus();
    });
    this.controls.refresh();
    this.update();
    this.draw();
  }

  /** Whoever guesses is asked again for each other drop, until "Just show me". */
  private change(): void {
    const key = dropOf(this.state.parameters);
    const asks = this.state.predict && key !== this.askedOf;
    this.askedOf = key;
    if (asks) {
      this.player.pause();
      this.prediction.open(true);
      this.choose(1);
    }
    this.update();
    if (!asks) return;
    // The picture is the drop's beginning.
    this.followsImpact = false;
    this.state.time = -Infinity;
  }

  private update(): void {
    const { parameters } = this.state;
    // Into space and back the layout goes along; any other time it stays what was chosen.
    const inPlane = isInPlane(parameters);
    if (inPlane !== this.wasInPlane && !this.state.lock.includes("layout")) this.state.layout = usualLayout(parameters);
    this.wasInPlane = inPlane;
    this.showLayout();
    this.asked = performance.now();
    this.followsImpact = this.hasShown;
    const both = this.both.areShown;
    document.body.classList.toggle("discrete-only", !both);
    byId("of-ground").classList.toggle("serves-both", parameters.ofGround);
    this.tabs.setUsable("force", both);
    if (!both) this.state.layout = "overlay";
    if (isUsed(parameters, "angle")) this.prediction.awaits(seenAngle(bodyOf(parameters), parameters.angle));
    this.models.ask(parameters, both);
    this.fan.update();
    this.tabs.setUsable("map", this.map.show(parameters));
    showNotes(parameters);
    this.remember();
  }

  /** Another situation as a whole, from a file or the story. */
  private showAnew(): void {
    this.player.pause();
    this.explained = this.state.impact;
    this.controls.refresh();
    this.update();
  }

  private onError(model: ModelName, error: ApiError | null): void {
    this.controls.setError(model, error);
    // Of a drop that is refused there is nothing to guess.
    if (model === "discrete") document.body.classList.toggle("refused", error !== null);
  }

  private onAnswer(): void {
    const { models } = this;
    this.picture.rescale();
    this.rewarp();
    if (models.discrete) this.prediction.setImpacts(models.discrete, models.discreteOf);
    this.story.setImpacts(models.steps);
    this.table.show(models.impacts, models.pairing, this.state.impact);
    this.strip.show(models.motions, models.pairing, this.state.impact);
    showWarnings(models.discrete?.warnings ?? []);
    byId("outcome").textContent = models.discrete ? outcomeInWords(models.discrete.outcome) : "";
    this.showChosen();
    if (!this.player.playing) {
      // While a slider moves the picture stays with the chosen impact, whenever that is now.
      const impact = this.followsImpact || Number.isNaN(this.state.time) ? this.models.steps[this.state.impact - 1] : undefined;
      if (impact) this.state.time = impact.start;
      this.player.seek(this.state.time || 0);
      this.story.seen(this.player.time, false);
    }
    this.hasShown = true;
    // The time that is wanted stays, even if it lies beyond what the first model to answer can show.
    this.draw();
    this.showGuessed();
    writeAddress(this.state);
    // For whoever measures how fast the page answers.
    const { dataset } = document.documentElement;
    if (!models.continuous || !dataset["latency"]) dataset["latency"] = (performance.now() - this.asked).toFixed(1);
  }

  private rewarp(): void {
    const warp = this.models.warp(this.state.slow);
    if (!warp) return;
    this.player.setWarp(warp);
    this.transport.setMarks(this.models.steps.map((step) => ({
      place: this.player.progressAt(step.start), name: `${step.n}${step.predictable === false ? "?" : ""}`,
    })));
  }

  private onTime(ended = false): void {
    const impact = impactAt(this.models.steps, this.player.time);
    if (impact && impact.n !== this.state.impact && this.player.playing) this.choose(impact.n, this.explained);
    const { time, playing } = this.player;
    if (playing && time > this.playedTo) this.sound.pass(this.models.steps, this.playedTo, time);
    // What was passed by while the picture stood is not heard afterwards.
    this.playedTo = time;
    this.draw();
    this.capture.drawn(ended);
    this.prediction.seen(this.player.time);
    this.story.seen(this.player.time, ended);
    if (!this.player.playing) this.remember();
  }

  /** What goes wrong in it is told, and the rest of the page goes on. */
  private draw(): void {
    const { player } = this;
    try {
      this.transport.show(player.time, player.progress, player.playing, player.slowness);
      if (!this.hand.draw()) this.picture.draw(player.time, player.playing, this.prediction.isOpen);
      if (this.isBroken) this.controls.setError("picture", null);
      this.isBroken = false;
    } catch (error) {
      this.isBroken = true;
      this.controls.setError("picture", new ApiError(`this moment cannot be drawn: ${String(error)}`));
    }
  }

  private choose(n: number, explained = n): void {
    this.state.impact = n;
    this.explained = explained;
    this.table.choose(n);
    this.strip.choose(n);
    this.showChosen();
  }

  /** To an impact; one step back from between two impacts is to the one before. */
  private goTo(n: number, direction = 0): void {
    const count = this.models.steps.length;
    if (!count || this.prediction.isOpen) return;
    const here = impactAt(this.models.steps, this.player.time)?.n ?? 0;
    const wanted = direction === 0 ? n : here + direction;
    const chosen = Math.min(count, Math.max(1, wanted));
    this.put(chosen, this.models.steps[chosen - 1]?.start ?? 0);
  }

  /** The picture at a time, with an impact chosen. */
  private put(n: number, time: number): void {
    this.player.pause();
    clearTimeout(this.playTimer);
    this.choose(n);
    this.player.seek(time);
    this.onTime();
  }

  /** To an impact of either model; the equations and steps are those of the discrete one. */
  private goToImpact(model: ModelName, n: number): void {
    const impact = this.models.impacts[model]?.[n - 1];
    if (this.models.impacts.discrete?.[n - 1]) this.goTo(n);
    if (!impact || model === "discrete") return;
    this.player.seek(impact.start);
    this.onTime();
  }

  private scrub(progress: number): void {
    this.player.pause();
    this.followsImpact = false;
    this.player.progress = progress;
    const impact = impactAt(this.models.steps, this.player.time);
    if (impact && impact.n !== this.state.impact) this.choose(impact.n);
    this.onTime();
  }

  private toggle(): void {
    if (this.prediction.isOpen) return;
    this.followsImpact = false;
    if (this.player.playing) this.player.pause();
    else {
      this.player.play();
      // A blow at this very moment is to be heard.
      this.playedTo = this.player.time - 1e-9;
    }
    this.onTime();
  }

  private playReal(): void {
    if (this.prediction.isOpen) return;
    this.followsImpact = false;
    this.playedTo = -Infinity;
    this.player.playReal();
  }

  /** After a slider is let go the drop is played; with reduced motion only when asked for. */
  private playSoon(delay = PLAY_DELAY): void {
    clearTimeout(this.playTimer);
    if (this.prediction.isOpen || matchMedia("(prefers-reduced-motion: reduce)").matches) return;
    this.playTimer = window.setTimeout(() => this.playAnew(), delay);
  }

  private playAnew(): void {
    this.player.pause();
    this.player.progress = 0;
    this.player.play();
  }

  private onPredicted(asksOn: boolean): void {
    this.state.predict &&= asksOn;
    byId<HTMLInputElement>("ask-first").checked = this.state.predict;
    this.remember();
    this.onTime();
    this.showGuessed();
    this.playSoon();
    byId("play").focus();
  }

  /** Who wants no motion is shown the second blow, of which the guess was. */
  private showGuessed(): void {
    if (matchMedia("(prefers-reduced-motion: reduce)").matches && this.prediction.isWaiting) this.goTo(2);
  }

  private setAngle(angle: number): void {
    if (isFixed(this.state) || this.state.lock.includes("angle")) return;
    this.state.parameters.angle = angle;
    this.askedOf = dropOf(this.state.parameters);  // the map tells what would be asked
    this.controls.refresh();
    this.update();
    this.playSoon();
  }

  private showChosen(): void {
    const { models: { continuous, motions }, state: { impact } } = this;
    this.picture.force.show(continuous, motions.discrete, impact);
    showProfile(motions.discrete, impact);
    if (this.state.hide.includes("explain") || !this.models.discrete) return;
    byId("explain-title").textContent = `How impact ${this.explained} came about`;
    explaining.ask(explainRequest(this.state.parameters, this.explained), null);
  }

  private remember(): void {
    // A time beyond the end of what has answered so far is still wanted.
    const awaits = this.player.progress >= 1 && this.state.time > this.player.time;
    if (this.hasShown && !awaits) this.state.time = this.player.time;
    writeAddress(this.state);
  }
}

new Page();
setUpTracks();
