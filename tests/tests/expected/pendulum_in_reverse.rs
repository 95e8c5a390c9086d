#[allow(unused_variables, clippy::all)]
impl<T: ::mbs_runtime::Real> Pendulum<T> {
    ///Backward through `Hoisted`.
    fn transposed_new(
        &self,
        given: &::mbs_runtime::reverse::Given<'_, T>,
        weights: &[T],
        adjoints: &mut ::mbs_runtime::reverse::Adjoints<'_, T>,
    ) -> ::core::option::Option<()> {
        let (t, h, half_h) = (given.t, given.h, T::from_f64(0.5) * given.h);
        let (t_next, gains) = (given.t_next, &given.gains);
        let weight_array = weights.first_chunk::<5>()?;
        let v0 = T::from_f64(1.0) / self.parameters.length;
        let v1 = weight_array[4] * T::from_f64(0.5);
        let v2 = weight_array[3] * T::from_f64(9.81);
        let v3 = v1 + v2;
        let v4 = weight_array[1] * T::from_f64(0.5);
        let v5 = weight_array[2] + v4;
        let v6 = v5 / self.parameters.length;
        let v7 = v6 * v0;
        let v8 = -v7;
        let v9 = weight_array[0] * T::from_f64(0.5);
        let v10 = v8 + v9;
        {
            let sums = adjoints.parameters.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v10;
            sums[1] = sums[1] + v3;
        }
        ::core::option::Option::Some(())
    }
    ///Backward through `Stabilized`.
    fn transposed_stabilized(
        &self,
        given: &::mbs_runtime::reverse::Given<'_, T>,
        weights: &[T],
        adjoints: &mut ::mbs_runtime::reverse::Adjoints<'_, T>,
    ) -> ::core::option::Option<()> {
        let (t, h, half_h) = (given.t, given.h, T::from_f64(0.5) * given.h);
        let (t_next, gains) = (given.t_next, &given.gains);
        let position_array = given.q.first_chunk::<2>()?;
        let velocity_array = given.v.first_chunk::<2>()?;
        let weight_array = weights.first_chunk::<3>()?;
        let phi_q_rod_x = self.hoisted[2] * position_array[0];
        let v1 = phi_q_rod_x * phi_q_rod_x;
        let phi_q_rod_y = position_array[1] * self.hoisted[2];
        let v3 = phi_q_rod_y * phi_q_rod_y;
        let v4 = v3 + v1;
        let v5 = position_array[0] * position_array[0];
        let v6 = position_array[1] * position_array[1];
        let v7 = v6 + v5;
        let v8 = self.hoisted[1] * v7;
        let phi_rod = v8 - self.hoisted[0];
        let v10 = gains.minus_beta_squared * phi_rod;
        let v11 = T::from_f64(2.0) * velocity_array[0];
        let v12 = position_array[0] * v11;
        let v13 = T::from_f64(2.0) * velocity_array[1];
        let v14 = position_array[1] * v13;
        let v15 = v14 + v12;
        let phi_dot_rod = self.hoisted[1] * v15;
        let v17 = gains.minus_two_alpha * phi_dot_rod;
        let feedback_rod = v17 + v10;
        let v19 = velocity_array[0] * v11;
        let v20 = velocity_array[1] * v13;
        let v21 = v20 + v19;
        let v22 = self.hoisted[1] * v21;
        let v23 = T::from_f64(9.81) * phi_q_rod_y;
        let v24 = v23 - v22;
        let v25 = v24 + feedback_rod;
        let v26 = v25 / v4;
        let v27 = weight_array[1] * v26;
        let v28 = weight_array[1] * phi_q_rod_y;
        let v29 = weight_array[0] * v26;
        let v30 = weight_array[0] * phi_q_rod_x;
        let v31 = v28 + v30;
        let v32 = v31 / v4;
        let v33 = v32 * v26;
        let v34 = -v33;
        let v35 = weight_array[2] + v32;
        let v36 = -v32;
        let v37 = v32 * T::from_f64(9.81);
        let v38 = v27 + v37;
        let v39 = v36 * v21;
        let v40 = v36 * self.hoisted[1];
        let v41 = v40 * v13;
        let v42 = v40 * velocity_array[1];
        let v43 = v40 * v11;
        let v44 = v40 * velocity_array[0];
        let v45 = v35 * gains.minus_two_alpha;
        let v46 = v45 * v15;
        let v47 = v45 * self.hoisted[1];
        let v48 = v39 + v46;
        let v49 = v47 * v13;
        let v50 = v47 * position_array[1];
        let v51 = v42 + v50;
        let v52 = v51 * T::from_f64(2.0);
        let v53 = v41 + v52;
        let v54 = v47 * v11;
        let v55 = v47 * position_array[0];
        let v56 = v44 + v55;
        let v57 = v56 * T::from_f64(2.0);
        let v58 = v43 + v57;
        let v59 = v35 * gains.minus_beta_squared;
        let v60 = -v59;
        let v61 = v59 * v7;
        let v62 = v59 * self.hoisted[1];
        let v63 = v48 + v61;
        let v64 = v62 * position_array[1];
        let v65 = v49 + v64;
        let v66 = v65 + v64;
        let v67 = v62 * position_array[0];
        let v68 = v54 + v67;
        let v69 = v68 + v67;
        let v70 = v34 * phi_q_rod_y;
        let v71 = v38 + v70;
        let v72 = v71 + v70;
        let v73 = v72 * self.hoisted[2];
        let v74 = v72 * position_array[1];
        let v75 = v66 + v73;
        let v76 = v34 * phi_q_rod_x;
        let v77 = v29 + v76;
        let v78 = v77 + v76;
        let v79 = v78 * position_array[0];
        let v80 = v78 * self.hoisted[2];
        let v81 = v74 + v79;
        let v82 = v69 + v80;
        {
            let sums = adjoints.q.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v82;
            sums[1] = sums[1] + v75;
        }
        {
            let sums = adjoints.v.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v58;
            sums[1] = sums[1] + v53;
        }
        {
            let sums = adjoints.hoisted.first_chunk_mut::<3>()?;
            sums[0] = sums[0] + v60;
            sums[1] = sums[1] + v63;
            sums[2] = sums[2] + v81;
        }
        ::core::option::Option::Some(())
    }
    ///Backward through `Constrained`.
    fn transposed_constrained(
        &self,
        given: &::mbs_runtime::reverse::Given<'_, T>,
        weights: &[T],
        adjoints: &mut ::mbs_runtime::reverse::Adjoints<'_, T>,
    ) -> ::core::option::Option<()> {
        let (t, h, half_h) = (given.t, given.h, T::from_f64(0.5) * given.h);
        let (t_next, gains) = (given.t_next, &given.gains);
        let position_array = given.q.first_chunk::<2>()?;
        let velocity_array = given.v.first_chunk::<2>()?;
        let feedback_array = given.feedback.first_chunk::<1>()?;
        let weight_array = weights.first_chunk::<2>()?;
        let phi_q_rod_x = self.hoisted[2] * position_array[0];
        let v1 = phi_q_rod_x * phi_q_rod_x;
        let phi_q_rod_y = position_array[1] * self.hoisted[2];
        let v3 = phi_q_rod_y * phi_q_rod_y;
        let v4 = v3 + v1;
        let v5 = T::from_f64(2.0) * velocity_array[0];
        let v6 = velocity_array[0] * v5;
        let v7 = T::from_f64(2.0) * velocity_array[1];
        let v8 = velocity_array[1] * v7;
        let v9 = v8 + v6;
        let v10 = self.hoisted[1] * v9;
        let v11 = T::from_f64(9.81) * phi_q_rod_y;
        let v12 = feedback_array[0] + v11;
        let v13 = v12 - v10;
        let v14 = v13 / v4;
        let v15 = weight_array[1] * v14;
        let v16 = weight_array[1] * phi_q_rod_y;
        let v17 = weight_array[0] * v14;
        let v18 = weight_array[0] * phi_q_rod_x;
        let v19 = v16 + v18;
        let v20 = v19 / v4;
        let v21 = v20 * v14;
        let v22 = -v21;
        let v23 = -v20;
        let v24 = v20 * T::from_f64(9.81);
        let v25 = v15 + v24;
        let v26 = v23 * v9;
        let v27 = v23 * self.hoisted[1];
        let v28 = v27 * v7;
        let v29 = v27 * velocity_array[1];
        let v30 = v29 * T::from_f64(2.0);
        let v31 = v28 + v30;
        let v32 = v27 * v5;
        let v33 = v27 * velocity_array[0];
        let v34 = v33 * T::from_f64(2.0);
        let v35 = v32 + v34;
        let v36 = v22 * phi_q_rod_y;
        let v37 = v25 + v36;
        let v38 = v37 + v36;
        let v39 = v38 * self.hoisted[2];
        let v40 = v38 * position_array[1];
        let v41 = v22 * phi_q_rod_x;
        let v42 = v17 + v41;
        let v43 = v42 + v41;
        let v44 = v43 * position_array[0];
        let v45 = v43 * self.hoisted[2];
        let v46 = v40 + v44;
        {
            let sums = adjoints.q.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v45;
            sums[1] = sums[1] + v39;
        }
        {
            let sums = adjoints.v.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v35;
            sums[1] = sums[1] + v31;
        }
        {
            let sums = adjoints.feedback.first_chunk_mut::<1>()?;
            sums[0] = sums[0] + v20;
        }
        {
            let sums = adjoints.hoisted.first_chunk_mut::<3>()?;
            sums[1] = sums[1] + v26;
            sums[2] = sums[2] + v46;
        }
        ::core::option::Option::Some(())
    }
    ///Backward through `Complete`.
    fn transposed_complete(
        &self,
        given: &::mbs_runtime::reverse::Given<'_, T>,
        weights: &[T],
        adjoints: &mut ::mbs_runtime::reverse::Adjoints<'_, T>,
    ) -> ::core::option::Option<()> {
        let (t, h, half_h) = (given.t, given.h, T::from_f64(0.5) * given.h);
        let (t_next, gains) = (given.t_next, &given.gains);
        let weight_array = weights.first_chunk::<4>()?;
        {
            let sums = adjoints.q.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + weight_array[0];
            sums[1] = sums[1] + weight_array[1];
        }
        {
            let sums = adjoints.v.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + weight_array[2];
            sums[1] = sums[1] + weight_array[3];
        }
        ::core::option::Option::Some(())
    }
    ///Backward through `Phi`.
    fn transposed_phi(
        &self,
        given: &::mbs_runtime::reverse::Given<'_, T>,
        weights: &[T],
        adjoints: &mut ::mbs_runtime::reverse::Adjoints<'_, T>,
    ) -> ::core::option::Option<()> {
        let (t, h, half_h) = (given.t, given.h, T::from_f64(0.5) * given.h);
        let (t_next, gains) = (given.t_next, &given.gains);
        let position_array = given.q.first_chunk::<2>()?;
        let weight_array = weights.first_chunk::<1>()?;
        let v0 = position_array[0] * position_array[0];
        let v1 = position_array[1] * position_array[1];
        let v2 = v1 + v0;
        let v3 = -weight_array[0];
        let v4 = weight_array[0] * v2;
        let v5 = weight_array[0] * self.hoisted[1];
        let v6 = v5 * position_array[1];
        let v7 = v6 + v6;
        let v8 = v5 * position_array[0];
        let v9 = v8 + v8;
        {
            let sums = adjoints.q.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v9;
            sums[1] = sums[1] + v7;
        }
        {
            let sums = adjoints.hoisted.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v3;
            sums[1] = sums[1] + v4;
        }
        ::core::option::Option::Some(())
    }
    ///Backward through `PhiDot`.
    fn transposed_phi_dot(
        &self,
        given: &::mbs_runtime::reverse::Given<'_, T>,
        weights: &[T],
        adjoints: &mut ::mbs_runtime::reverse::Adjoints<'_, T>,
    ) -> ::core::option::Option<()> {
        let (t, h, half_h) = (given.t, given.h, T::from_f64(0.5) * given.h);
        let (t_next, gains) = (given.t_next, &given.gains);
        let position_array = given.q.first_chunk::<2>()?;
        let velocity_array = given.v.first_chunk::<2>()?;
        let weight_array = weights.first_chunk::<1>()?;
        let v0 = T::from_f64(2.0) * velocity_array[0];
        let v1 = position_array[0] * v0;
        let v2 = T::from_f64(2.0) * velocity_array[1];
        let v3 = position_array[1] * v2;
        let v4 = v3 + v1;
        let v5 = weight_array[0] * v4;
        let v6 = weight_array[0] * self.hoisted[1];
        let v7 = v6 * v2;
        let v8 = v6 * position_array[1];
        let v9 = v8 * T::from_f64(2.0);
        let v10 = v6 * v0;
        let v11 = v6 * position_array[0];
        let v12 = v11 * T::from_f64(2.0);
        {
            let sums = adjoints.q.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v10;
            sums[1] = sums[1] + v7;
        }
        {
            let sums = adjoints.v.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v12;
            sums[1] = sums[1] + v9;
        }
        {
            let sums = adjoints.hoisted.first_chunk_mut::<2>()?;
            sums[1] = sums[1] + v5;
        }
        ::core::option::Option::Some(())
    }
    ///Backward through `Projection`.
    fn transposed_projection(
        &self,
        given: &::mbs_runtime::reverse::Given<'_, T>,
        weights: &[T],
        adjoints: &mut ::mbs_runtime::reverse::Adjoints<'_, T>,
    ) -> ::core::option::Option<()> {
        let (t, h, half_h) = (given.t, given.h, T::from_f64(0.5) * given.h);
        let (t_next, gains) = (given.t_next, &given.gains);
        let position_array = given.q.first_chunk::<2>()?;
        let feedback_array = given.feedback.first_chunk::<1>()?;
        let weight_array = weights.first_chunk::<2>()?;
        let phi_q_rod_x = self.hoisted[2] * position_array[0];
        let v1 = phi_q_rod_x * phi_q_rod_x;
        let phi_q_rod_y = position_array[1] * self.hoisted[2];
        let v3 = phi_q_rod_y * phi_q_rod_y;
        let v4 = v3 + v1;
        let v5 = feedback_array[0] / v4;
        let v6 = weight_array[1] * v5;
        let v7 = weight_array[1] * phi_q_rod_y;
        let v8 = weight_array[0] * v5;
        let v9 = weight_array[0] * phi_q_rod_x;
        let v10 = v7 + v9;
        let v11 = v10 / v4;
        let v12 = v11 * v5;
        let v13 = -v12;
        let v14 = v13 * phi_q_rod_y;
        let v15 = v6 + v14;
        let v16 = v15 + v14;
        let v17 = v16 * self.hoisted[2];
        let v18 = v16 * position_array[1];
        let v19 = v13 * phi_q_rod_x;
        let v20 = v8 + v19;
        let v21 = v20 + v19;
        let v22 = v21 * position_array[0];
        let v23 = v21 * self.hoisted[2];
        let v24 = v18 + v22;
        {
            let sums = adjoints.q.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v23;
            sums[1] = sums[1] + v17;
        }
        {
            let sums = adjoints.feedback.first_chunk_mut::<1>()?;
            sums[0] = sums[0] + v11;
        }
        {
            let sums = adjoints.hoisted.first_chunk_mut::<3>()?;
            sums[2] = sums[2] + v24;
        }
        ::core::option::Option::Some(())
    }
    ///Backward through `Reactions`.
    fn transposed_reactions(
        &self,
        given: &::mbs_runtime::reverse::Given<'_, T>,
        weights: &[T],
        adjoints: &mut ::mbs_runtime::reverse::Adjoints<'_, T>,
    ) -> ::core::option::Option<()> {
        let (t, h, half_h) = (given.t, given.h, T::from_f64(0.5) * given.h);
        let (t_next, gains) = (given.t_next, &given.gains);
        let position_array = given.q.first_chunk::<2>()?;
        let velocity_array = given.v.first_chunk::<2>()?;
        let feedback_array = given.feedback.first_chunk::<1>()?;
        let weight_array = weights.first_chunk::<3>()?;
        let phi_q_rod_x = self.hoisted[2] * position_array[0];
        let v1 = phi_q_rod_x * phi_q_rod_x;
        let phi_q_rod_y = position_array[1] * self.hoisted[2];
        let v3 = phi_q_rod_y * phi_q_rod_y;
        let v4 = v3 + v1;
        let v5 = T::from_f64(2.0) * velocity_array[0];
        let v6 = velocity_array[0] * v5;
        let v7 = T::from_f64(2.0) * velocity_array[1];
        let v8 = velocity_array[1] * v7;
        let v9 = v8 + v6;
        let v10 = self.hoisted[1] * v9;
        let v11 = T::from_f64(9.81) * phi_q_rod_y;
        let v12 = feedback_array[0] + v11;
        let v13 = v12 - v10;
        let v14 = v13 / v4;
        let v15 = -weight_array[2];
        let v16 = v15 * v14;
        let v17 = v15 * self.parameters.mass;
        let v18 = weight_array[1] * v14;
        let v19 = weight_array[1] * phi_q_rod_y;
        let v20 = v17 + v19;
        let v21 = weight_array[0] * v14;
        let v22 = weight_array[0] * phi_q_rod_x;
        let v23 = v20 + v22;
        let v24 = v23 / v4;
        let v25 = v24 * v14;
        let v26 = -v25;
        let v27 = -v24;
        let v28 = v24 * T::from_f64(9.81);
        let v29 = v18 + v28;
        let v30 = v27 * v9;
        let v31 = v27 * self.hoisted[1];
        let v32 = v31 * v7;
        let v33 = v31 * velocity_array[1];
        let v34 = v33 * T::from_f64(2.0);
        let v35 = v32 + v34;
        let v36 = v31 * v5;
        let v37 = v31 * velocity_array[0];
        let v38 = v37 * T::from_f64(2.0);
        let v39 = v36 + v38;
        let v40 = v26 * phi_q_rod_y;
        let v41 = v29 + v40;
        let v42 = v41 + v40;
        let v43 = v42 * self.hoisted[2];
        let v44 = v42 * position_array[1];
        let v45 = v26 * phi_q_rod_x;
        let v46 = v21 + v45;
        let v47 = v46 + v45;
        let v48 = v47 * position_array[0];
        let v49 = v47 * self.hoisted[2];
        let v50 = v44 + v48;
        {
            let sums = adjoints.parameters.first_chunk_mut::<2>()?;
            sums[1] = sums[1] + v16;
        }
        {
            let sums = adjoints.q.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v49;
            sums[1] = sums[1] + v43;
        }
        {
            let sums = adjoints.v.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v39;
            sums[1] = sums[1] + v35;
        }
        {
            let sums = adjoints.feedback.first_chunk_mut::<1>()?;
            sums[0] = sums[0] + v24;
        }
        {
            let sums = adjoints.hoisted.first_chunk_mut::<3>()?;
            sums[1] = sums[1] + v30;
            sums[2] = sums[2] + v50;
        }
        ::core::option::Option::Some(())
    }
    ///Backward through `Outputs`.
    fn transposed_outputs(
        &self,
        given: &::mbs_runtime::reverse::Given<'_, T>,
        weights: &[T],
        adjoints: &mut ::mbs_runtime::reverse::Adjoints<'_, T>,
    ) -> ::core::option::Option<()> {
        let (t, h, half_h) = (given.t, given.h, T::from_f64(0.5) * given.h);
        let (t_next, gains) = (given.t_next, &given.gains);
        let position_array = given.q.first_chunk::<2>()?;
        let multiplier_array = given.multipliers.first_chunk::<1>()?;
        let weight_array = weights.first_chunk::<2>()?;
        let v0 = position_array[0] * position_array[0];
        let v1 = position_array[1] * position_array[1];
        let v2 = v1 + v0;
        let sqrt_v2 = v2.sqrt();
        let v4 = self.hoisted[2] * multiplier_array[0];
        let v5 = -position_array[1];
        let v6 = v5 * v5;
        let v7 = v0 + v6;
        let v8 = v5 / v7;
        let v9 = position_array[0] / v7;
        let v10 = -v9;
        let v11 = weight_array[1] * v8;
        let v12 = weight_array[1] * v10;
        let v13 = -v12;
        let v14 = weight_array[0] * sqrt_v2;
        let v15 = weight_array[0] * v4;
        let v16 = v14 * multiplier_array[0];
        let v17 = v14 * self.hoisted[2];
        let v18 = T::from_f64(1.0) / sqrt_v2;
        let v19 = T::from_f64(0.5) * v18;
        let v20 = v15 * v19;
        let v21 = v20 * position_array[1];
        let v22 = v13 + v21;
        let v23 = v22 + v21;
        let v24 = v20 * position_array[0];
        let v25 = v11 + v24;
        let v26 = v25 + v24;
        {
            let sums = adjoints.q.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v26;
            sums[1] = sums[1] + v23;
        }
        {
            let sums = adjoints.multipliers.first_chunk_mut::<1>()?;
            sums[0] = sums[0] + v17;
        }
        {
            let sums = adjoints.hoisted.first_chunk_mut::<3>()?;
            sums[2] = sums[2] + v16;
        }
        ::core::option::Option::Some(())
    }
    ///Backward through `StepHeld`.
    fn transposed_step_held(
        &self,
        given: &::mbs_runtime::reverse::Given<'_, T>,
        weights: &[T],
        adjoints: &mut ::mbs_runtime::reverse::Adjoints<'_, T>,
    ) -> ::core::option::Option<()> {
        let (t, h, half_h) = (given.t, given.h, T::from_f64(0.5) * given.h);
        let (t_next, gains) = (given.t_next, &given.gains);
        let position_array = given.q.first_chunk::<2>()?;
        let velocity_array = given.v.first_chunk::<2>()?;
        let weight_array = weights.first_chunk::<4>()?;
        let phi_q_rod_x = self.hoisted[2] * position_array[0];
        let v1 = phi_q_rod_x * phi_q_rod_x;
        let phi_q_rod_y = position_array[1] * self.hoisted[2];
        let v3 = phi_q_rod_y * phi_q_rod_y;
        let v4 = v3 + v1;
        let v5 = position_array[0] * position_array[0];
        let v6 = position_array[1] * position_array[1];
        let v7 = v6 + v5;
        let v8 = self.hoisted[1] * v7;
        let phi_rod = v8 - self.hoisted[0];
        let v10 = gains.minus_beta_squared * phi_rod;
        let v11 = T::from_f64(2.0) * velocity_array[0];
        let v12 = position_array[0] * v11;
        let v13 = T::from_f64(2.0) * velocity_array[1];
        let v14 = position_array[1] * v13;
        let v15 = v14 + v12;
        let phi_dot_rod = self.hoisted[1] * v15;
        let v17 = gains.minus_two_alpha * phi_dot_rod;
        let feedback_rod = v17 + v10;
        let v19 = velocity_array[0] * v11;
        let v20 = velocity_array[1] * v13;
        let v21 = v20 + v19;
        let v22 = self.hoisted[1] * v21;
        let v23 = T::from_f64(9.81) * phi_q_rod_y;
        let v24 = v23 - v22;
        let v25 = v24 + feedback_rod;
        let v26 = v25 / v4;
        let acc_x = phi_q_rod_x * v26;
        let v28 = phi_q_rod_y * v26;
        let acc_y = v28 - T::from_f64(9.81);
        let v30 = h * velocity_array[0];
        let v31 = position_array[0] + v30;
        let v32 = h * acc_x;
        let v33 = velocity_array[0] + v32;
        let v34 = h * velocity_array[1];
        let v35 = position_array[1] + v34;
        let v36 = h * acc_y;
        let v37 = velocity_array[1] + v36;
        let v38 = self.hoisted[2] * v31;
        let v39 = v38 * v38;
        let v40 = v35 * self.hoisted[2];
        let v41 = v40 * v40;
        let v42 = v41 + v39;
        let v43 = T::from_f64(2.0) * v33;
        let v44 = v33 * v43;
        let v45 = T::from_f64(2.0) * v37;
        let v46 = v37 * v45;
        let v47 = v46 + v44;
        let v48 = self.hoisted[1] * v47;
        let v49 = T::from_f64(9.81) * v40;
        let v50 = feedback_rod + v49;
        let v51 = v50 - v48;
        let v52 = v51 / v42;
        let v53 = weight_array[3] * half_h;
        let v54 = weight_array[2] * half_h;
        let v55 = weight_array[1] * half_h;
        let v56 = weight_array[3] + v55;
        let v57 = weight_array[0] * half_h;
        let v58 = weight_array[2] + v57;
        let v59 = v53 * v52;
        let v60 = v53 * v40;
        let v61 = v54 * v52;
        let v62 = v54 * v38;
        let v63 = v60 + v62;
        let v64 = v63 / v42;
        let v65 = v64 * v52;
        let v66 = -v65;
        let v67 = -v64;
        let v68 = v64 * T::from_f64(9.81);
        let v69 = v59 + v68;
        let v70 = v67 * v47;
        let v71 = v67 * self.hoisted[1];
        let v72 = v71 * v45;
        let v73 = v71 * v37;
        let v74 = v55 + v72;
        let v75 = v73 * T::from_f64(2.0);
        let v76 = v74 + v75;
        let v77 = v71 * v43;
        let v78 = v71 * v33;
        let v79 = v57 + v77;
        let v80 = v78 * T::from_f64(2.0);
        let v81 = v79 + v80;
        let v82 = v66 * v40;
        let v83 = v69 + v82;
        let v84 = v83 + v82;
        let v85 = v84 * self.hoisted[2];
        let v86 = v84 * v35;
        let v87 = v66 * v38;
        let v88 = v61 + v87;
        let v89 = v88 + v87;
        let v90 = v89 * v31;
        let v91 = v89 * self.hoisted[2];
        let v92 = v86 + v90;
        let v93 = v56 + v76;
        let v94 = v76 * h;
        let v95 = v53 + v94;
        let v96 = weight_array[1] + v85;
        let v97 = v85 * h;
        let v98 = v93 + v97;
        let v99 = v58 + v81;
        let v100 = v81 * h;
        let v101 = v54 + v100;
        let v102 = weight_array[0] + v91;
        let v103 = v91 * h;
        let v104 = v99 + v103;
        let v105 = v95 * v26;
        let v106 = v95 * phi_q_rod_y;
        let v107 = v101 * v26;
        let v108 = v101 * phi_q_rod_x;
        let v109 = v106 + v108;
        let v110 = v109 / v4;
        let v111 = v110 * v26;
        let v112 = -v111;
        let v113 = v64 + v110;
        let v114 = -v110;
        let v115 = v110 * T::from_f64(9.81);
        let v116 = v105 + v115;
        let v117 = v114 * v21;
        let v118 = v114 * self.hoisted[1];
        let v119 = v70 + v117;
        let v120 = v118 * v13;
        let v121 = v118 * velocity_array[1];
        let v122 = v98 + v120;
        let v123 = v118 * v11;
        let v124 = v118 * velocity_array[0];
        let v125 = v104 + v123;
        let v126 = v113 * gains.minus_two_alpha;
        let v127 = v126 * v15;
        let v128 = v126 * self.hoisted[1];
        let v129 = v119 + v127;
        let v130 = v128 * v13;
        let v131 = v128 * position_array[1];
        let v132 = v96 + v130;
        let v133 = v121 + v131;
        let v134 = v133 * T::from_f64(2.0);
        let v135 = v122 + v134;
        let v136 = v128 * v11;
        let v137 = v128 * position_array[0];
        let v138 = v102 + v136;
        let v139 = v124 + v137;
        let v140 = v139 * T::from_f64(2.0);
        let v141 = v125 + v140;
        let v142 = v113 * gains.minus_beta_squared;
        let v143 = -v142;
        let v144 = v142 * v7;
        let v145 = v142 * self.hoisted[1];
        let v146 = v129 + v144;
        let v147 = v145 * position_array[1];
        let v148 = v132 + v147;
        let v149 = v148 + v147;
        let v150 = v145 * position_array[0];
        let v151 = v138 + v150;
        let v152 = v151 + v150;
        let v153 = v112 * phi_q_rod_y;
        let v154 = v116 + v153;
        let v155 = v154 + v153;
        let v156 = v155 * self.hoisted[2];
        let v157 = v155 * position_array[1];
        let v158 = v149 + v156;
        let v159 = v92 + v157;
        let v160 = v112 * phi_q_rod_x;
        let v161 = v107 + v160;
        let v162 = v161 + v160;
        let v163 = v162 * position_array[0];
        let v164 = v162 * self.hoisted[2];
        let v165 = v159 + v163;
        let v166 = v152 + v164;
        {
            let sums = adjoints.q.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v166;
            sums[1] = sums[1] + v158;
        }
        {
            let sums = adjoints.v.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v141;
            sums[1] = sums[1] + v135;
        }
        {
            let sums = adjoints.hoisted.first_chunk_mut::<3>()?;
            sums[0] = sums[0] + v143;
            sums[1] = sums[1] + v146;
            sums[2] = sums[2] + v165;
        }
        ::core::option::Option::Some(())
    }
    ///Backward through `StepPerStage`.
    fn transposed_step_per_stage(
        &self,
        given: &::mbs_runtime::reverse::Given<'_, T>,
        weights: &[T],
        adjoints: &mut ::mbs_runtime::reverse::Adjoints<'_, T>,
    ) -> ::core::option::Option<()> {
        let (t, h, half_h) = (given.t, given.h, T::from_f64(0.5) * given.h);
        let (t_next, gains) = (given.t_next, &given.gains);
        let position_array = given.q.first_chunk::<2>()?;
        let velocity_array = given.v.first_chunk::<2>()?;
        let weight_array = weights.first_chunk::<4>()?;
        let phi_q_rod_x = self.hoisted[2] * position_array[0];
        let v1 = phi_q_rod_x * phi_q_rod_x;
        let phi_q_rod_y = position_array[1] * self.hoisted[2];
        let v3 = phi_q_rod_y * phi_q_rod_y;
        let v4 = v3 + v1;
        let v5 = position_array[0] * position_array[0];
        let v6 = position_array[1] * position_array[1];
        let v7 = v6 + v5;
        let v8 = self.hoisted[1] * v7;
        let phi_rod = v8 - self.hoisted[0];
        let v10 = gains.minus_beta_squared * phi_rod;
        let v11 = T::from_f64(2.0) * velocity_array[0];
        let v12 = position_array[0] * v11;
        let v13 = T::from_f64(2.0) * velocity_array[1];
        let v14 = position_array[1] * v13;
        let v15 = v14 + v12;
        let phi_dot_rod = self.hoisted[1] * v15;
        let v17 = gains.minus_two_alpha * phi_dot_rod;
        let feedback_rod = v17 + v10;
        let v19 = velocity_array[0] * v11;
        let v20 = velocity_array[1] * v13;
        let v21 = v20 + v19;
        let v22 = self.hoisted[1] * v21;
        let v23 = T::from_f64(9.81) * phi_q_rod_y;
        let v24 = v23 - v22;
        let v25 = v24 + feedback_rod;
        let v26 = v25 / v4;
        let acc_x = phi_q_rod_x * v26;
        let v28 = phi_q_rod_y * v26;
        let acc_y = v28 - T::from_f64(9.81);
        let v30 = h * velocity_array[0];
        let v31 = position_array[0] + v30;
        let v32 = h * acc_x;
        let v33 = velocity_array[0] + v32;
        let v34 = h * velocity_array[1];
        let v35 = position_array[1] + v34;
        let v36 = h * acc_y;
        let v37 = velocity_array[1] + v36;
        let v38 = self.hoisted[2] * v31;
        let v39 = v38 * v38;
        let v40 = v35 * self.hoisted[2];
        let v41 = v40 * v40;
        let v42 = v41 + v39;
        let v43 = v31 * v31;
        let v44 = v35 * v35;
        let v45 = v44 + v43;
        let v46 = self.hoisted[1] * v45;
        let v47 = v46 - self.hoisted[0];
        let v48 = gains.minus_beta_squared * v47;
        let v49 = T::from_f64(2.0) * v33;
        let v50 = v31 * v49;
        let v51 = T::from_f64(2.0) * v37;
        let v52 = v35 * v51;
        let v53 = v52 + v50;
        let v54 = self.hoisted[1] * v53;
        let v55 = gains.minus_two_alpha * v54;
        let v56 = v55 + v48;
        let v57 = v33 * v49;
        let v58 = v37 * v51;
        let v59 = v58 + v57;
        let v60 = self.hoisted[1] * v59;
        let v61 = T::from_f64(9.81) * v40;
        let v62 = v61 - v60;
        let v63 = v62 + v56;
        let v64 = v63 / v42;
        let v65 = weight_array[3] * half_h;
        let v66 = weight_array[2] * half_h;
        let v67 = weight_array[1] * half_h;
        let v68 = weight_array[3] + v67;
        let v69 = weight_array[0] * half_h;
        let v70 = weight_array[2] + v69;
        let v71 = v65 * v64;
        let v72 = v65 * v40;
        let v73 = v66 * v64;
        let v74 = v66 * v38;
        let v75 = v72 + v74;
        let v76 = v75 / v42;
        let v77 = v76 * v64;
        let v78 = -v77;
        let v79 = -v76;
        let v80 = v76 * T::from_f64(9.81);
        let v81 = v71 + v80;
        let v82 = v79 * v59;
        let v83 = v79 * self.hoisted[1];
        let v84 = v83 * v51;
        let v85 = v83 * v37;
        let v86 = v67 + v84;
        let v87 = v83 * v49;
        let v88 = v83 * v33;
        let v89 = v69 + v87;
        let v90 = v76 * gains.minus_two_alpha;
        let v91 = v90 * v53;
        let v92 = v90 * self.hoisted[1];
        let v93 = v82 + v91;
        let v94 = v92 * v51;
        let v95 = v92 * v35;
        let v96 = v85 + v95;
        let v97 = v96 * T::from_f64(2.0);
        let v98 = v86 + v97;
        let v99 = v92 * v49;
        let v100 = v92 * v31;
        let v101 = v88 + v100;
        let v102 = v101 * T::from_f64(2.0);
        let v103 = v89 + v102;
        let v104 = v76 * gains.minus_beta_squared;
        let v105 = -v104;
        let v106 = v104 * v45;
        let v107 = v104 * self.hoisted[1];
        let v108 = v93 + v106;
        let v109 = v107 * v35;
        let v110 = v94 + v109;
        let v111 = v110 + v109;
        let v112 = v107 * v31;
        let v113 = v99 + v112;
        let v114 = v113 + v112;
        let v115 = v78 * v40;
        let v116 = v81 + v115;
        let v117 = v116 + v115;
        let v118 = v117 * self.hoisted[2];
        let v119 = v117 * v35;
        let v120 = v111 + v118;
        let v121 = v78 * v38;
        let v122 = v73 + v121;
        let v123 = v122 + v121;
        let v124 = v123 * v31;
        let v125 = v123 * self.hoisted[2];
        let v126 = v119 + v124;
        let v127 = v114 + v125;
        let v128 = v68 + v98;
        let v129 = v98 * h;
        let v130 = v65 + v129;
        let v131 = weight_array[1] + v120;
        let v132 = v120 * h;
        let v133 = v128 + v132;
        let v134 = v70 + v103;
        let v135 = v103 * h;
        let v136 = v66 + v135;
        let v137 = weight_array[0] + v127;
        let v138 = v127 * h;
        let v139 = v134 + v138;
        let v140 = v130 * v26;
        let v141 = v130 * phi_q_rod_y;
        let v142 = v136 * v26;
        let v143 = v136 * phi_q_rod_x;
        let v144 = v141 + v143;
        let v145 = v144 / v4;
        let v146 = v145 * v26;
        let v147 = -v146;
        let v148 = -v145;
        let v149 = v145 * T::from_f64(9.81);
        let v150 = v140 + v149;
        let v151 = v148 * v21;
        let v152 = v148 * self.hoisted[1];
        let v153 = v108 + v151;
        let v154 = v152 * v13;
        let v155 = v152 * velocity_array[1];
        let v156 = v133 + v154;
        let v157 = v152 * v11;
        let v158 = v152 * velocity_array[0];
        let v159 = v139 + v157;
        let v160 = v145 * gains.minus_two_alpha;
        let v161 = v160 * v15;
        let v162 = v160 * self.hoisted[1];
        let v163 = v153 + v161;
        let v164 = v162 * v13;
        let v165 = v162 * position_array[1];
        let v166 = v131 + v164;
        let v167 = v155 + v165;
        let v168 = v167 * T::from_f64(2.0);
        let v169 = v156 + v168;
        let v170 = v162 * v11;
        let v171 = v162 * position_array[0];
        let v172 = v137 + v170;
        let v173 = v158 + v171;
        let v174 = v173 * T::from_f64(2.0);
        let v175 = v159 + v174;
        let v176 = v145 * gains.minus_beta_squared;
        let v177 = -v176;
        let v178 = v105 + v177;
        let v179 = v176 * v7;
        let v180 = v176 * self.hoisted[1];
        let v181 = v163 + v179;
        let v182 = v180 * position_array[1];
        let v183 = v166 + v182;
        let v184 = v183 + v182;
        let v185 = v180 * position_array[0];
        let v186 = v172 + v185;
        let v187 = v186 + v185;
        let v188 = v147 * phi_q_rod_y;
        let v189 = v150 + v188;
        let v190 = v189 + v188;
        let v191 = v190 * self.hoisted[2];
        let v192 = v190 * position_array[1];
        let v193 = v184 + v191;
        let v194 = v126 + v192;
        let v195 = v147 * phi_q_rod_x;
        let v196 = v142 + v195;
        let v197 = v196 + v195;
        let v198 = v197 * position_array[0];
        let v199 = v197 * self.hoisted[2];
        let v200 = v194 + v198;
        let v201 = v187 + v199;
        {
            let sums = adjoints.q.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v201;
            sums[1] = sums[1] + v193;
        }
        {
            let sums = adjoints.v.first_chunk_mut::<2>()?;
            sums[0] = sums[0] + v175;
            sums[1] = sums[1] + v169;
        }
        {
            let sums = adjoints.hoisted.first_chunk_mut::<3>()?;
            sums[0] = sums[0] + v178;
            sums[1] = sums[1] + v181;
            sums[2] = sums[2] + v200;
        }
        ::core::option::Option::Some(())
    }
}
#[allow(clippy::all)]
impl<T: ::mbs_runtime::Real> ::mbs_runtime::reverse::Transposed for Pendulum<T> {
    const HAS_STEP: ::core::primitive::bool = true;
    fn transposed(
        &self,
        function: ::mbs_runtime::reverse::Function,
        given: &::mbs_runtime::reverse::Given<'_, T>,
        weights: &[T],
        adjoints: &mut ::mbs_runtime::reverse::Adjoints<'_, T>,
    ) -> ::core::option::Option<()> {
        match function {
            ::mbs_runtime::reverse::Function::Hoisted => {
                Self::transposed_new(self, given, weights, adjoints)
            }
            ::mbs_runtime::reverse::Function::Stabilized => {
                Self::transposed_stabilized(self, given, weights, adjoints)
            }
            ::mbs_runtime::reverse::Function::Constrained => {
                Self::transposed_constrained(self, given, weights, adjoints)
            }
            ::mbs_runtime::reverse::Function::Complete => {
                Self::transposed_complete(self, given, weights, adjoints)
            }
            ::mbs_runtime::reverse::Function::Phi => {
                Self::transposed_phi(self, given, weights, adjoints)
            }
            ::mbs_runtime::reverse::Function::PhiDot => {
                Self::transposed_phi_dot(self, given, weights, adjoints)
            }
            ::mbs_runtime::reverse::Function::Projection => {
                Self::transposed_projection(self, given, weights, adjoints)
            }
            ::mbs_runtime::reverse::Function::Reactions => {
                Self::transposed_reactions(self, given, weights, adjoints)
            }
            ::mbs_runtime::reverse::Function::Outputs => {
                Self::transposed_outputs(self, given, weights, adjoints)
            }
            ::mbs_runtime::reverse::Function::StepHeld => {
                Self::transposed_step_held(self, given, weights, adjoints)
            }
            ::mbs_runtime::reverse::Function::StepPerStage => {
                Self::transposed_step_per_stage(self, given, weights, adjoints)
            }
        }
    }
}
